// SPDX-License-Identifier: BSD-3-Clause
// Declarations of the geometry shader that VTK inserts for edges: what it must hand through.
//@if VisibilityOfPoints
in vec4 visibility0VSOutput[];
out vec4 visibility0GSOutput;
//@if VisibilityOfBack
in vec4 visibilityBack0VSOutput[];
out vec4 visibilityBack0GSOutput;
//@end
//@end
//@if VisibilityOfPoints2
in vec4 visibility1VSOutput[];
out vec4 visibility1GSOutput;
//@if VisibilityOfBack
in vec4 visibilityBack1VSOutput[];
out vec4 visibilityBack1GSOutput;
//@end
//@end
//@if VisibilityOfPoints3
in vec4 visibility2VSOutput[];
out vec4 visibility2GSOutput;
//@end
//@if VisibilityOfPoints4
in vec4 visibility3VSOutput[];
out vec4 visibility3GSOutput;
//@end
//@if ColorsOfPoints
in vec4 colorVSOutput[];
out vec4 colorGSOutput;
//@end
//@if ScalarsOfPoints
in vec2 scalarVSOutput[];
out vec2 scalarGSOutput;
//@end
//@if FieldOfPoints
in vec3 fieldVSOutput[];
out vec3 fieldGSOutput;
//@if FieldOfBack
in vec3 fieldBackVSOutput[];
out vec3 fieldBackGSOutput;
//@end
//@end
//@if FragmentPosition
in vec3 positionVSOutput[];
out vec3 positionGSOutput;
//@end
//@if PerVertex
in vec3 diffuseFrontVSOutput[];
out vec3 diffuseFrontGSOutput;
//@if LightAmbient
in vec3 ambientLightVSOutput[];
out vec3 ambientLightGSOutput;
//@end
//@if Specular
in vec3 specularFrontVSOutput[];
out vec3 specularFrontGSOutput;
//@end
//@if TwoSided
in vec3 diffuseBackVSOutput[];
out vec3 diffuseBackGSOutput;
//@if Specular
in vec3 specularBackVSOutput[];
out vec3 specularBackGSOutput;
//@end
//@end
//@end
