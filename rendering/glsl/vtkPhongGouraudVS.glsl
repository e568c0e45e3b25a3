// SPDX-License-Identifier: BSD-3-Clause
// //VTK::Light::Impl of the vertex shader: Gouraud's sums over the lights at each vertex.
//@if ColorsOfPoints
  colorVSOutput = radiometryColorMC;
//@end
//@if ScalarsOfPoints
  scalarVSOutput = radiometryScalarMC;
//@end
//@if FieldOfPoints
  fieldVSOutput = radiometryFieldMC;
//@if FieldOfBack
  fieldBackVSOutput = radiometryFieldBackMC;
//@end
//@end
//@if PerVertex
  {
    vec3 N = safeNormal(normalMatrix * normalMC);
//@if Specular
//@if LocalViewer
    vec3 V = -vertexVCVSOutput.xyz / max(length(vertexVCVSOutput.xyz), 1e-37);
//@else
    vec3 V = vec3(0.0, 0.0, 1.0);
//@end
//@end
    LightSums sums = sumLights(vertexVCVSOutput.xyz, N
//@if Specular
      , V, specularPowerUniform
//@end
      );
    diffuseFrontVSOutput = sums.diffuse;
//@if LightAmbient
    ambientLightVSOutput = sums.ambient;
//@end
//@if Specular
    specularFrontVSOutput = sums.specular;
//@end
//@if TwoSided
    sums = sumLights(vertexVCVSOutput.xyz, -N
//@if Specular
      , V,
//@if BackMaterial
      specularPowerUniformBF
//@else
      specularPowerUniform
//@end
//@end
      );
    diffuseBackVSOutput = sums.diffuse;
//@if Specular
    specularBackVSOutput = sums.specular;
//@end
//@end
  }
//@end
