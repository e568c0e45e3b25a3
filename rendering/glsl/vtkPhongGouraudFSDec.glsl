// SPDX-License-Identifier: BSD-3-Clause
// Declarations of the fragment shader (//VTK::Light::Dec).
//@if CellFrame
// For each triangle that is drawn: its cell's normal, its cell's centre.
uniform samplerBuffer radiometryCellFrames;
uniform mat3 normalMatrix;
//@end
//@if PerCell
uniform mat4 MCVCMatrix;
//@end
//@if Field
uniform float fieldScale;
//@end
//@if FieldOfCells
uniform samplerBuffer radiometryField;
//@end
//@if FieldOfPoints
in vec3 fieldVSOutput;
//@if FieldOfBack
in vec3 fieldBackVSOutput;
//@end
//@end
//@if Materials
// For each triangle the number of its material; for each material, front then back: diffuse
// reflectance and exponent, specular reflectance, emitted radiance.
uniform samplerBuffer radiometryMaterialOfCell;
uniform samplerBuffer radiometryMaterials;
//@end
//@if ShowNormals
uniform mat3 viewToWorld;
//@end
//@if Ambient
uniform vec3 globalAmbient;
//@end
//@if Emission
uniform vec3 emission;
//@if TwoSided
uniform vec3 backEmission;
//@end
//@end
//@if PerVertex
in vec3 diffuseFrontVSOutput;
//@if LightAmbient
in vec3 ambientLightVSOutput;
//@end
//@if Specular
in vec3 specularFrontVSOutput;
//@end
//@if TwoSided
in vec3 diffuseBackVSOutput;
//@if Specular
in vec3 specularBackVSOutput;
//@end
//@end
//@end
