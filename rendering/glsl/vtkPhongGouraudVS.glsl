// SPDX-License-Identifier: BSD-3-Clause
// //VTK::Light::Impl of the vertex shader: Gouraud's sums over the lights at each vertex.
//@if VisibilityOfPoints
  visibility0VSOutput = radiometryVisibility0MC;
//@if VisibilityOfBack
  visibilityBack0VSOutput = radiometryVisibilityBack0MC;
//@end
//@end
//@if VisibilityOfPoints2
  visibility1VSOutput = radiometryVisibility1MC;
//@if VisibilityOfBack
  visibilityBack1VSOutput = radiometryVisibilityBack1MC;
//@end
//@end
//@if VisibilityOfPoints3
  visibility2VSOutput = radiometryVisibility2MC;
//@end
//@if VisibilityOfPoints4
  visibility3VSOutput = radiometryVisibility3MC;
//@end
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
//@if FragmentPosition
  positionVSOutput = MCLCMatrix * vertexMC.xyz;
//@end
//@if PerVertex
  {
//@if Position
    vec3 P = MCLCMatrix * vertexMC.xyz;
//@end
    vec3 N = safeNormal(normalMatrix * normalMC);
//@if Specular
//@if LocalViewer
    vec3 V = eyeLC - P;
    V *= inversesqrt(max(dot(V, V), 1e-37));
//@else
    vec3 V = vec3(0.0, 0.0, 1.0);
//@end
//@end
    LightSums sums = sumLights(N
//@if Finite
      , P
//@end
//@if Specular
      , V, specularPowerUniform
//@if BothSides
//@if BackMaterial
      , specularPowerUniformBF
//@else
      , specularPowerUniform
//@end
//@end
//@end
      );
    diffuseFrontVSOutput = sums.diffuse;
//@if LightAmbient
    ambientLightVSOutput = sums.ambient;
//@end
//@if Specular
    specularFrontVSOutput = sums.specular;
//@end
//@if BothSides
    diffuseBackVSOutput = sums.diffuseBack;
//@if Specular
    specularBackVSOutput = sums.specularBack;
//@end
//@end
  }
//@end
