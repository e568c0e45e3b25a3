// SPDX-License-Identifier: BSD-3-Clause
// Declarations of the geometry shader that VTK inserts for edges: what it must hand through.
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
