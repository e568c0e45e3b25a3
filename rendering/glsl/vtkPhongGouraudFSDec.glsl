// SPDX-License-Identifier: BSD-3-Clause
// Declarations of the fragment shader (//VTK::Light::Dec).
//@if CellFrame
// For each triangle that is drawn: its cell's normal, its cell's centre.
uniform samplerBuffer radiometryCellFrames;
uniform mat3 normalMatrix;
//@end
//@if PerTriangle
// For each triangle that is drawn: 1 where the light of its corners is interpolated. Four a texel.
uniform samplerBuffer radiometryShading;
//@end
//@if FragmentPosition
in vec3 positionVSOutput;
//@end
//@if CellPosition
uniform mat3 MCLCMatrix;
//@end
//@if FragmentViewer
uniform vec3 eyeLC;
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
//@if VisibilityOfCells
uniform ivec2 visibilityTexels; // of a side, of a triangle
//@end
//@if VisibilityOfPoints
in vec4 visibility0VSOutput;
//@if VisibilityOfBack
in vec4 visibilityBack0VSOutput;
//@end
//@end
//@if VisibilityOfPoints2
in vec4 visibility1VSOutput;
//@if VisibilityOfBack
in vec4 visibilityBack1VSOutput;
//@end
//@end
//@if VisibilityOfPoints3
in vec4 visibility2VSOutput;
//@end
//@if VisibilityOfPoints4
in vec4 visibility3VSOutput;
//@end
//@if FalseColor
//@if ColorsOfCells
// For each triangle its colour; alpha -1: that of its points, -2: the property's.
uniform samplerBuffer radiometryCellColors;
//@end
//@if ColorsOfPoints
in vec4 colorVSOutput;
//@end
//@if ScalarsOfPoints
// ColorSteps.h: of NaN, then of each step where it begins, its colour, its opacity.
uniform samplerBuffer radiometryColorSteps;
uniform int numberOfColorSteps;
in vec2 scalarVSOutput;

vec4 colorOfScalar(vec2 scalar)
{
  int step = 0;
  if (scalar.y <= 0.0)
  {
    int end = numberOfColorSteps + 1;
    step = 1;
    while (end - step > 1)
    {
      int middle = (step + end) / 2;
      if (texelFetch(radiometryColorSteps, middle).x <= scalar.x)
      {
        step = middle;
      }
      else
      {
        end = middle;
      }
    }
  }
  vec4 texel = texelFetch(radiometryColorSteps, step);
  int color = int(texel.y);
  return vec4(color & 255, (color >> 8) & 255, color >> 16, 255.0 * texel.z) / 255.0;
}
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
