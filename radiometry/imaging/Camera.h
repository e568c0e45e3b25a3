// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace radiometry
{

/// Irradiance of the image that a camera makes of a surface of radiance L, in the unit of pi L
/// [W/m^2 for W/(m^2 sr)], before losses in the glass.
///   Reads   radiance; fNumber N = focal length/diameter of the entrance pupil, > 0; cosAlpha, the
///           cosine of the angle between the camera's axis and the ray from the eye to the point
///   Model   E = L pi/4 cos^4(alpha)/N^2; 0 for cosAlpha <= 0, behind the camera
///   Limits  the pupil small beside its distance from the image, the object far away. How far off
///           it is: CosFourthDeviation
///   Source  Reiss 1945, The cos^4 law of illumination
///   Fails   InputError{FNumber} unless it is positive and finite
double ImageIrradiance(double radiance, double fNumber, double cosAlpha);

/// The same of many tuples of `bands` values, with one cosine a tuple.
std::vector<double> ImageIrradiance(const std::vector<double>& radiance, int bands, double fNumber,
  const std::vector<double>& cosAlpha);

/// Adds to errors of the above what cos^4 varies over each tuple's picture: L times the difference
/// between the law at the middle and at its mean (NaN: no picture, nothing is added).
void AddCosFourthSpread(const std::vector<double>& radiance, int bands, double fNumber,
  const std::vector<double>& cosAlpha, const std::vector<double>& meanCosFourth,
  std::vector<double>& errors);

/// The same without the approximation, for a thin lens whose pupil is a disc in its plane, seen whole
/// from every point of the image (no vignetting).
///   Model   E = pi L F, F the configuration factor from an element of the image plane to a
///           parallel disc: with T = tan(alpha), R = 1/(2 N (1 + m)), q = 1 + T^2 - R^2,
///           s = sqrt(q^2 + 4 R^2): F = (1 - q/s)/2. On the axis R^2/(1 + R^2)
///   Reads   magnification m >= 0, image size over object size: 0 for objects far away; the image
///           then lies at (1 + m) focal lengths, and the working f-number is N (1 + m)
///   Source  Walsh 1958; Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-13
///   Fails   InputError{FNumber}, InputError{Magnification}
double ThinLensImageIrradiance(
  double radiance, double fNumber, double cosAlpha, double magnification = 0.0);

/// The same on the axis of a lens that obeys the sine condition (aplanatic, as camera lenses are):
/// E = pi L sin^2(theta'), sin(theta') = 1/(2 N (1 + m)); for m = 0 this is pi L/(4 N^2) exactly, so
/// there the usual law has no error at all. N of at least 1/2 (air).
double AplanaticImageIrradiance(double radiance, double fNumber, double magnification = 0.0);

/// (E_cos4 - E_thin lens)/E_thin lens of the two models above, m = 0 in the first: what the usual law
/// makes wrong of a thin lens. About R^2 (1 - 4 sin^2 + ...) for far objects: at f/8 0.4 %, at f/2.8
/// 3 %, at f/1.4 13 % on the axis; and (1 + m)^2 - 1 for near ones.
double CosFourthDeviation(double fNumber, double cosAlpha, double magnification = 0.0);

/// Where a thin lens of that focal length makes the image of an object at `distance` (both m, from
/// the lens): 1/v = 1/f - 1/d. Infinite for an object in the focal plane, below 0 for a nearer one
/// (a virtual image).
double ImageDistance(double focalLength, double distance);

/// Image size over object size, f/(d - f); below 0 for a virtual image.
double Magnification(double focalLength, double distance);

} // namespace radiometry
