// SPDX-License-Identifier: BSD-3-Clause
// Declarations of the vertex shader (//VTK::Light::Dec).
//@if VisibilityOfPoints
in vec4 radiometryVisibility0MC;
out vec4 visibility0VSOutput;
//@if VisibilityOfBack
in vec4 radiometryVisibilityBack0MC;
out vec4 visibilityBack0VSOutput;
//@end
//@end
//@if VisibilityOfPoints2
in vec4 radiometryVisibility1MC;
out vec4 visibility1VSOutput;
//@if VisibilityOfBack
in vec4 radiometryVisibilityBack1MC;
out vec4 visibilityBack1VSOutput;
//@end
//@end
//@if VisibilityOfPoints3
in vec4 radiometryVisibility2MC;
out vec4 visibility2VSOutput;
//@end
//@if VisibilityOfPoints4
in vec4 radiometryVisibility3MC;
out vec4 visibility3VSOutput;
//@end
//@if ColorsOfPoints
in vec4 radiometryColorMC;
out vec4 colorVSOutput;
//@end
//@if ScalarsOfPoints
in vec2 radiometryScalarMC;
out vec2 scalarVSOutput;
//@end
//@if FieldOfPoints
in vec3 radiometryFieldMC;
out vec3 fieldVSOutput;
//@if FieldOfBack
in vec3 radiometryFieldBackMC;
out vec3 fieldBackVSOutput;
//@end
//@end
//@if FragmentPosition
uniform mat3 MCLCMatrix;
out vec3 positionVSOutput;
//@end
//@if PerVertex
//@if !FragmentPosition
//@if Position
uniform mat3 MCLCMatrix;
//@end
//@end
//@if Specular
//@if LocalViewer
uniform vec3 eyeLC;
//@end
uniform float specularPowerUniform;
//@if TwoSided
//@if BackMaterial
uniform float specularPowerUniformBF;
//@end
//@end
//@end
out vec3 diffuseFrontVSOutput;
//@if LightAmbient
out vec3 ambientLightVSOutput;
//@end
//@if Specular
out vec3 specularFrontVSOutput;
//@end
//@if TwoSided
out vec3 diffuseBackVSOutput;
//@if Specular
out vec3 specularBackVSOutput;
//@end
//@end
//@end
