// SPDX-License-Identifier: BSD-3-Clause
// //VTK::Light::Impl of that geometry shader, once for each vertex i.
//@if VisibilityOfPoints
  visibility0GSOutput = visibility0VSOutput[i];
//@if VisibilityOfBack
  visibilityBack0GSOutput = visibilityBack0VSOutput[i];
//@end
//@end
//@if VisibilityOfPoints2
  visibility1GSOutput = visibility1VSOutput[i];
//@if VisibilityOfBack
  visibilityBack1GSOutput = visibilityBack1VSOutput[i];
//@end
//@end
//@if VisibilityOfPoints3
  visibility2GSOutput = visibility2VSOutput[i];
//@end
//@if VisibilityOfPoints4
  visibility3GSOutput = visibility3VSOutput[i];
//@end
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
