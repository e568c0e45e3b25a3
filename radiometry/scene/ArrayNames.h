// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The names of the arrays through which the parts of the project (and its users) meet.
/// Meaning, components and units: docs/arrays.md.
namespace radiometry
{
namespace names
{

// Surface (cell data, or field data of one tuple for a whole block)
inline constexpr char DiffuseReflectance[] = "DiffuseReflectance";
inline constexpr char SpecularReflectance[] = "SpecularReflectance";
inline constexpr char Shininess[] = "Shininess";
inline constexpr char EmittedExitance[] = "EmittedExitance";
inline constexpr char Transmittance[] = "Transmittance";
inline constexpr char DiffuseTransmittance[] = "DiffuseTransmittance";
inline constexpr char Ambient[] = "Ambient";
inline constexpr char TwoSided[] = "TwoSided"; // 0 or 1 per cell; overrides the filter's property
inline constexpr char ObjectTransform[] = "ObjectTransform"; // field data, 16 numbers
inline constexpr char BackPrefix[] = "Back";   // BackDiffuseReflectance, ...

// Lights (point data, one vertex a light)
inline constexpr char LightType[] = "LightType";
inline constexpr char Intensity[] = "Intensity";
inline constexpr char Direction[] = "Direction";
inline constexpr char SpotCutoff[] = "SpotCutoff";
inline constexpr char SpotInnerCutoff[] = "SpotInnerCutoff"; // degrees; < 0: a hard edge
inline constexpr char SpotExponent[] = "SpotExponent";
inline constexpr char Attenuation[] = "Attenuation";
inline constexpr char LightEnabled[] = "LightEnabled";
inline constexpr char AmbientColor[] = "AmbientColor";
inline constexpr char SpecularColor[] = "SpecularColor";
inline constexpr char PhotometricWeb[] = "PhotometricWeb";
inline constexpr char ReferenceDirection[] = "ReferenceDirection";
inline constexpr char LightTwoSided[] = "LightTwoSided";
inline constexpr char SkyModel[] = "SkyModel";
inline constexpr char SkyCoefficients[] = "SkyCoefficients";
inline constexpr char SunDirection[] = "SunDirection";
inline constexpr char EnvironmentMap[] = "EnvironmentMap";
inline constexpr char GroundRadiance[] = "GroundRadiance"; // of an environment, relative
inline constexpr char GlobalAmbient[] = "GlobalAmbient"; // field data, N bands
inline constexpr char AttachedTo[] = "AttachedTo";

// Results
inline constexpr char Irradiance[] = "Irradiance";
inline constexpr char Radiosity[] = "Radiosity";
inline constexpr char Radiance[] = "Radiance";
inline constexpr char Illuminance[] = "Illuminance";
inline constexpr char LuminousExitance[] = "LuminousExitance";
inline constexpr char Luminance[] = "Luminance";
inline constexpr char Dose[] = "Dose";                         // radiant exposure
inline constexpr char LuminousExposure[] = "LuminousExposure"; // its photometric counterpart
inline constexpr char LightVisibility[] = "LightVisibility"; // share of each light that arrives
// Field data: which lights those are, a tuple a light: type, position, direction as in its input
inline constexpr char LightVisibilityLights[] = "LightVisibilityLights";
inline constexpr char SolidAngle[] = "SolidAngle";                   // of a cell from an eye
inline constexpr char ProjectedSolidAngle[] = "ProjectedSolidAngle";
inline constexpr char Facing[] = "Facing"; // 1 front, -1 back, 0 neither
inline constexpr char OffAxisAngle[] = "OffAxisAngle"; // degrees
inline constexpr char ImageIrradiance[] = "ImageIrradiance"; // in a camera
inline constexpr char ImageIlluminance[] = "ImageIlluminance";
inline constexpr char EffectPlan[] = "EffectPlan"; // field data: a sentence an effect
inline constexpr char BackSuffix[] = "Back";   // IrradianceBack, ...
inline constexpr char ErrorSuffix[] = "Error"; // IrradianceError, ...

// Field data beside spectral arrays: the centres of their N bands [nm]
inline constexpr char Wavelengths[] = "Wavelengths";

// The cell of the input that a piece of the output was cut from
inline constexpr char OriginalCellIds[] = "OriginalCellIds";

// Sensors
inline constexpr char Normals[] = "Normals";
// Four corners of the piece of surface that a sensor stands for (12 components)
inline constexpr char SensorCell[] = "SensorCell";
// Field data: sensors along the sides of a regular grid (2 integers), and who decided that
inline constexpr char SensorGridDimensions[] = "SensorGridDimensions";
inline constexpr char SensorGridRule[] = "SensorGridRule";

} // namespace names
} // namespace radiometry
