// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkOpenEXRWriter_h
#define vtkOpenEXRWriter_h

#include "vtkRadiometryFiltersModule.h" // for export macro
#include "vtkWriter.h"

#include <map>    // for std::map
#include <string> // for std::string
#include <vector> // for std::vector

class vtkImageData;

/// Writes the point arrays of images as the channels of a scene-linear OpenEXR file.
///   Reads   one or more vtkImageData of one slice in x and y, or composite data of them: each image
///           becomes a part. Its point arrays become channels:
///             "RGB", "RGBA" or else the active scalars of 3 or 4 components: R, G, B (, A)
///             "N" or "Normals":  N.X, N.Y, N.Z
///             one component:     the array's name (Z, Irradiance, IrradianceError, ...)
///             three components:  name.R, name.G, name.B, or the names that the components have
///             any other number:  name.0, name.1, ...
///           A unit (vtkDataArray::UNITS_LABEL) becomes the attribute "name.units"; field data
///           become attributes of their name.
///   Writes  one part an image, scan lines or tiles; of several each has a name (SetPartName, else the
///           block's, else the field data "name", else part0, ...) and may have a view (SetPartView,
///           else the field data "view"): "left" and "right" of a stereo pair. Field data dataWindow
///           and displayWindow (as the reader makes them) place the pixels where the properties do
///           not. Floats and doubles in PixelType (or as SetArrayPixelType
///           says), integers as uint where none is negative, else as float. R, G, B of 8 or 16
///           bits count as 0 to 1. Row 0 of VTK is the lowest, of OpenEXR the highest: the picture
///           stands upright in both.
///   Cost    two passes over the arrays; no copy of float and double arrays
///   Fails   no arrays, several slices, two parts of one name, parts that differ in display window,
///           chromaticities or the aspect of pixels (the format makes them share these), NaN or infinity (unless KeepNonFinite), a value that the
///           pixel type cannot hold, a folder that cannot be written: an error event and a return
///           of 0. The file appears when it is complete; on a failure the target stays as it was.
class VTKRADIOMETRYFILTERS_EXPORT vtkOpenEXRWriter : public vtkWriter
{
public:
  static vtkOpenEXRWriter* New();
  vtkTypeMacro(vtkOpenEXRWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file to write, .exr.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// The first image, where the first input is no composite data.
  vtkImageData* GetImageInput();

  ///@{
  /// Name and view of a part, counted from 0 over all inputs and their blocks. Empty: as said above.
  void SetPartName(int part, const char* name);
  void SetPartView(int part, const char* view);
  void ClearPartNames();
  ///@}

  enum PixelTypes
  {
    Half = 0,
    Float = 1,
    UInt = 2
  };
  ///@{
  /// The type of channels from floating-point arrays: Half (11 bits, up to 65504) or Float
  /// (default).
  vtkSetClampMacro(PixelType, int, Half, Float);
  vtkGetMacro(PixelType, int);
  ///@}

  /// The type of the channels of one array: Half, Float or UInt. Later calls win.
  void SetArrayPixelType(const char* array, int type);
  void ClearArrayPixelTypes();

  enum Compressions
  {
    None = 0,
    RLE = 1,
    ZIPS = 2,
    ZIP = 3,
    PIZ = 4,
    PXR24 = 5,
    B44 = 6,
    B44A = 7,
    DWAA = 8,
    DWAB = 9
  };
  ///@{
  /// Default ZIP. From PXR24 on some values are rounded (PXR24: floats to 24 bits; B44 and DWA
  /// visibly, on half).
  vtkSetClampMacro(Compression, int, None, DWAB);
  vtkGetMacro(Compression, int);
  ///@}

  ///@{
  /// How much DWAA and DWAB may lose: 0 next to nothing, 45 (default) hardly visible, more is smaller.
  vtkSetClampMacro(DwaCompressionLevel, double, 0.0, 100000.0);
  vtkGetMacro(DwaCompressionLevel, double);
  ///@}

  ///@{
  /// Width and height of tiles in pixels. Default 0: scan lines.
  vtkSetClampMacro(TileSize, int, 0, 16384);
  vtkGetMacro(TileSize, int);
  ///@}

  ///@{
  /// xy of red, green, blue and white that R, G and B mean. Default Rec.709 with white D65.
  vtkSetVectorMacro(Chromaticities, double, 8);
  vtkGetVectorMacro(Chromaticities, double, 8);
  ///@}

  ///@{
  /// Luminance in cd/m^2 of R = G = B = 1. Default 0: not said.
  vtkSetClampMacro(WhiteLuminance, double, 0.0, VTK_FLOAT_MAX);
  vtkGetMacro(WhiteLuminance, double);
  ///@}

  ///@{
  /// xy of the colour that is to look neutral. Default (0, 0): not said.
  vtkSetVector2Macro(AdoptedNeutral, double);
  vtkGetVector2Macro(AdoptedNeutral, double);
  ///@}

  ///@{
  /// An attribute of the file: a unit, an option, a version. Later ones of the same name win, over
  /// field data too.
  void AddAttribute(const char* name, const char* value);
  void AddAttribute(const char* name, double value);
  void ClearAttributes();
  ///@}

  ///@{
  /// Whether the input's field data become attributes. Default on.
  vtkSetMacro(WriteFieldData, bool);
  vtkGetMacro(WriteFieldData, bool);
  vtkBooleanMacro(WriteFieldData, bool);
  ///@}

  ///@{
  /// Whether NaN and infinities are written as they are. Default off: the first one is an error
  /// that names channel, pixel and value.
  vtkSetMacro(KeepNonFinite, bool);
  vtkGetMacro(KeepNonFinite, bool);
  vtkBooleanMacro(KeepNonFinite, bool);
  ///@}

  ///@{
  /// Column and row (downward) of the upper left pixel in the file, of every part. Default (0, 0): as
  /// the field data dataWindow says, if it has the image's size, else that.
  vtkSetVector2Macro(DataWindowOrigin, int);
  vtkGetVector2Macro(DataWindowOrigin, int);
  ///@}

  ///@{
  /// The whole picture that the pixels are a part of: first column, first row, last column, last
  /// row. Default (0, 0, -1, -1): as the field data displayWindow says, else the pixels are the whole.
  vtkSetVector4Macro(DisplayWindow, int);
  vtkGetVector4Macro(DisplayWindow, int);
  ///@}

protected:
  vtkOpenEXRWriter();
  ~vtkOpenEXRWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkOpenEXRWriter(const vtkOpenEXRWriter&) = delete;
  void operator=(const vtkOpenEXRWriter&) = delete;

  struct Assembly;
  struct Picture;
  std::vector<Picture> GetPictures();

  char* FileName = nullptr;
  int PixelType = Float;
  int Compression = ZIP;
  double DwaCompressionLevel = 45.0;
  int TileSize = 0;
  double Chromaticities[8];
  double WhiteLuminance = 0.0;
  double AdoptedNeutral[2] = { 0.0, 0.0 };
  bool WriteFieldData = true;
  bool KeepNonFinite = false;
  int DataWindowOrigin[2] = { 0, 0 };
  int DisplayWindow[4] = { 0, 0, -1, -1 };
  std::map<std::string, int> ArrayPixelTypes;
  std::map<int, std::string> PartNames;
  std::map<int, std::string> PartViews;
  std::map<std::string, std::string> TextAttributes;
  std::map<std::string, double> NumberAttributes;
};

#endif
