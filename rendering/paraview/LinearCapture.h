// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/paraview/: the float picture of several processes as one, and as a file.
#ifndef LinearCapture_h
#define LinearCapture_h

#include <functional>
#include <string>
#include <vector>

class vtkLinearFloatPass;
class vtkMultiProcessController;
class vtkRenderer;

namespace vtkradiometry
{

/// What one process drew: Samples x Samples texels a pixel, the first row at the bottom.
struct LinearLayer
{
  int Width = 0; ///< in pixels
  int Height = 0;
  int Samples = 0;            ///< 0: nothing could be drawn
  std::vector<float> Color;   ///< RGBA, multiplied by alpha
  std::vector<float> Depth;   ///< of opaque surfaces, 0 at the near and 1 at the far plane
  std::vector<float> Nearest; ///< of any surface; empty where that is Depth
};

/// Draws the light of the renderer's visible props (vtkLinearFloatPass::RenderOffScreen).
LinearLayer DrawLayer(vtkLinearFloatPass* pass, vtkRenderer* renderer, int reduction);

/// Lays the nearer over the farther, sample by sample. False where their sizes differ.
bool Composite(LinearLayer& layer, const LinearLayer& other);

/// All layers of the processes as one, on process 0; the others are left as they are. Every process
/// calls it. False (on process 0) where one of them has none.
bool GatherLayers(vtkMultiProcessController* controller, LinearLayer& layer);

/// A picture: the mean of the samples, and the depth of the sample in the middle as a distance.
struct LinearPicture
{
  int Width = 0; ///< 0: no picture
  int Height = 0;
  std::vector<float> Color;    ///< RGBA, multiplied by alpha
  std::vector<float> Distance; ///< from the camera's plane, in the scene's units
};
LinearPicture Average(const LinearLayer& layer, const std::function<double(double)>& distanceOf);

/// The exposure, in stops, that brings the typical light of a picture (its geometric mean) to a
/// quarter of white, and keeps all but the brightest 2 % below white; 0 where there is no light.
double FittingStops(const LinearPicture& picture);

/// From the process that has the picture to the one at the other end.
void SendPicture(vtkMultiProcessController* controller, const LinearPicture& picture);
LinearPicture ReceivePicture(vtkMultiProcessController* controller);

/// What a file says of its picture beside the pixels.
struct CaptureNotes
{
  std::string SourceColorSpace; ///< empty: scene-linear Rec.709
  std::string Display;          ///< how the view showed it
  std::string View;
  std::string Look;
  double Exposure = 0.0;
  int Samples = 1;
};

/// Writes R, G, B, A and Z as 32-bit floats, with the camera as attributes.
///   Fails   radiometry::io::FileError: the folder cannot be written; NaN or infinity in the picture
void WritePicture(const std::string& fileName, const LinearPicture& picture,
  vtkRenderer* renderer, const CaptureNotes& notes);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: LinearCapture.h
