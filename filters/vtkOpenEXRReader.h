// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkOpenEXRReader_h
#define vtkOpenEXRReader_h

#include "vtkImageAlgorithm.h"
#include "vtkRadiometryFiltersModule.h" // for export macro

#include <string> // for std::string
#include <vector> // for std::vector

/// Reads a scene-linear OpenEXR file: every channel into point arrays of an image.
///   Writes  R, G, B (, A): "RGB" ("RGBA"), the active scalars; name.R, name.G, name.B (, .A) and
///           name.X, name.Y, name.Z and name.0, name.1, ...: one array "name" of so many components;
///           any other channel: an array of its name. Half and float arrive as float, uint as
///           unsigned int. Row 0 is the lowest. Origin: where the data window lies in the display
///           window, from its lower left. Attributes become field data, with dataWindow and
///           displayWindow; "name.units" also the unit of the array (vtkDataArray::UNITS_LABEL).
///           The field data "name" and "view" are the part's.
///   Model   luminance and chroma (Y, RY, BY) become R, G, B; other sub-sampled
///           channels are repeated to full size. Colours are converted on request (ColorSpace)
///   Cost    the memory of the picture; more than MemoryLimit is an error before any is taken
///   Fails   no file, not OpenEXR, damaged or cut short, deep data, NaN or infinity when
///           KeepNonFinite is off: an error event and an empty output
class VTKRADIOMETRYFILTERS_EXPORT vtkOpenEXRReader : public vtkImageAlgorithm
{
public:
  static vtkOpenEXRReader* New();
  vtkTypeMacro(vtkOpenEXRReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file to read.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// 1 where the file is an OpenEXR picture that can be read, by its headers.
  int CanReadFile(const char* fileName);

  ///@{
  /// Which part of a file of several. Default 0; up to the number of parts less one.
  vtkSetClampMacro(Part, int, 0, VTK_INT_MAX);
  vtkGetMacro(Part, int);
  ///@}

  /// Chooses the part of this name; it wins over Part. Default empty: Part counts.
  void SetPartName(const char* name);

  /// The number of parts, the name of the one that is read (often empty) and of any (counted from 0).
  /// Known after UpdateInformation.
  int GetNumberOfParts() const { return static_cast<int>(this->PartNames.size()); }
  std::string GetPartName() const { return this->PartName; }
  std::string GetPartName(int part) const;

  enum ColorSpaces
  {
    AsStored = 0,
    LinearRec709 = 1
  };
  ///@{
  /// Whether R, G, B stay as they are (AsStored, default; the field data chromaticities say what they
  /// mean) or become linear Rec.709 by the file's chromaticities: the same CIE XYZ, the white not
  /// adapted.
  vtkSetClampMacro(ColorSpace, int, AsStored, LinearRec709);
  vtkGetMacro(ColorSpace, int);
  ///@}

  ///@{
  /// Whether NaN and infinities are kept. Default on; off: the first one is an error that names
  /// channel, pixel and value.
  vtkSetMacro(KeepNonFinite, bool);
  vtkGetMacro(KeepNonFinite, bool);
  vtkBooleanMacro(KeepNonFinite, bool);
  ///@}

  ///@{
  /// The most memory in MiB that the pixels of the file may take. Default 4096.
  vtkSetClampMacro(MemoryLimit, int, 1, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

protected:
  vtkOpenEXRReader();
  ~vtkOpenEXRReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkOpenEXRReader(const vtkOpenEXRReader&) = delete;
  void operator=(const vtkOpenEXRReader&) = delete;

  char* FileName = nullptr;
  int Part = 0;
  bool KeepNonFinite = true;
  int MemoryLimit = 4096;
  int ColorSpace = AsStored;
  std::vector<std::string> PartNames;
  std::string PartName;
  std::string WantedName;
};

#endif
