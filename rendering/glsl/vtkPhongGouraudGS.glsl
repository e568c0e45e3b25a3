// SPDX-License-Identifier: BSD-3-Clause
// //VTK::Light::Impl of that geometry shader, once for each vertex i.
//@if ColorsOfPoints
  colorGSOutput = colorVSOutput[i];
//@end
//@if ScalarsOfPoints
  scalarGSOutput = scalarVSOutput[i];
//@end
//@if FieldOfPoints
  fieldGSOutput = fieldVSOutput[i];
//@if FieldOfBack
  fieldBackGSOutput = fieldBackVSOutput[i];
//@end
//@end
//@if FragmentPosition
  positionGSOutput = positionVSOutput[i];
//@end
//@if PerVertex
  diffuseFrontGSOutput = diffuseFrontVSOutput[i];
//@if LightAmbient
  ambientLightGSOutput = ambientLightVSOutput[i];
//@end
//@if Specular
  specularFrontGSOutput = specularFrontVSOutput[i];
//@end
//@if TwoSided
  diffuseBackGSOutput = diffuseBackVSOutput[i];
//@if Specular
  specularBackGSOutput = specularBackVSOutput[i];
//@end
//@end
//@end
