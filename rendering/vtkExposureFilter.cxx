// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExposureFilter.h"

#include "PicturePixels.h"
#include "radiometry/imaging/Exposure.h"
#include "radiometry/scene/InputError.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <sstream>

namespace imaging = radiometry::imaging;

vtkStandardNewMacro(vtkExposureFilter);

namespace
{

void AddNumber(vtkFieldData* field, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  field->AddArray(array);
}

std::string Summary(const imaging::ChosenExposure& chosen, std::size_t odd)
{
  std::ostringstream text;
  text.precision(4);
  text << "EV100 " << chosen.ExposureValue << ", gain " << chosen.Gain << " (" << chosen.Stops
       << " stops)";
  if (chosen.NoLight)
  {
    text << "; no light to measure";
  }
  if (odd > 0)
  {
    text << "; " << odd << " pixels are not finite";
  }
  return text.str();
}

} // namespace

vtkExposureFilter::vtkExposureFilter() = default;

int vtkExposureFilter::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Superclass::RequestInformation(request, inputs, outputs))
  {
    return 0;
  }
  vtkDataObject::SetPointDataActiveScalarInfo(outputs->GetInformationObject(0), VTK_FLOAT, -1);
  return 1;
}

int vtkExposureFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // A percentile is of the whole picture, whatever part is asked for.
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  int whole[6];
  in->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  in->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), whole, 6);
  return 1;
}

int vtkExposureFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(input);
  this->UsedExposureValue = this->UsedStops = 0.0;
  this->UsedGain = 1.0;
  this->NonFinitePixels = 0;
  try
  {
    PicturePixels pixels = ReadPicture(input, "", this->GetInputArrayToProcess(0, inputs), 4);
    const double perUnit =
      this->LuminancePerUnit != 0.0 ? this->LuminancePerUnit : ::LuminancePerUnit(pixels.Unit);
    const imaging::ExposureSettings settings{ static_cast<imaging::ExposureMode>(this->Mode),
      this->ExposureValue, this->FNumber, this->ShutterTime, this->IsoSpeed, this->KeyValue,
      this->Percentile, this->PercentileLevel, this->Compensation };
    const auto luminances =
      imaging::PixelLuminances(pixels.Values.data(), pixels.Count(), pixels.Components, perUnit);
    const imaging::ChosenExposure chosen = imaging::ChooseExposure(luminances, perUnit, settings);
    const std::size_t odd = imaging::ApplyGain(
      pixels.Values.data(), pixels.Count(), pixels.Components, chosen.Gain, this->RepairPixels);

    vtkNew<vtkFloatArray> exposed;
    exposed->SetName(pixels.Name.c_str());
    exposed->SetNumberOfComponents(pixels.Components);
    exposed->SetNumberOfTuples(static_cast<vtkIdType>(pixels.Count()));
    std::copy(pixels.Values.begin(), pixels.Values.end(), exposed->GetPointer(0));
    output->GetPointData()->AddArray(exposed);
    output->GetPointData()->SetActiveScalars(exposed->GetName());

    this->UsedExposureValue = chosen.ExposureValue;
    this->UsedGain = chosen.Gain;
    this->UsedStops = chosen.Stops;
    this->NonFinitePixels = static_cast<vtkIdType>(odd);
    vtkFieldData* field = output->GetFieldData();
    AddNumber(field, "ExposureValue", chosen.ExposureValue);
    AddNumber(field, "ExposureGain", chosen.Gain);
    AddNumber(field, "ExposureStops", chosen.Stops);
    vtkNew<vtkIdTypeArray> count;
    count->SetName("NonFinitePixels");
    count->InsertNextValue(this->NonFinitePixels);
    field->AddArray(count);
    vtkNew<vtkStringArray> summary;
    summary->SetName("ExposureSummary");
    summary->InsertNextValue(Summary(chosen, odd));
    field->AddArray(summary);
  }
  catch (const radiometry::InputError& error)
  {
    vtkErrorMacro(<< error.what() << "; the image is unchanged");
  }
  return 1;
}

void vtkExposureFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << this->Mode << "\n"
     << indent << "ExposureValue: " << this->ExposureValue << "\n"
     << indent << "FNumber: " << this->FNumber << "\n"
     << indent << "ShutterTime: " << this->ShutterTime << " s\n"
     << indent << "IsoSpeed: " << this->IsoSpeed << "\n"
     << indent << "KeyValue: " << this->KeyValue << "\n"
     << indent << "Percentile: " << this->Percentile << " %\n"
     << indent << "PercentileLevel: " << this->PercentileLevel << "\n"
     << indent << "Compensation: " << this->Compensation << "\n"
     << indent << "LuminancePerUnit: " << this->LuminancePerUnit << " cd/m^2\n"
     << indent << "RepairPixels: " << this->RepairPixels << "\n"
     << indent << "UsedExposureValue: " << this->UsedExposureValue << "\n"
     << indent << "UsedGain: " << this->UsedGain << "\n"
     << indent << "UsedStops: " << this->UsedStops << "\n"
     << indent << "NonFinitePixels: " << this->NonFinitePixels << "\n";
}
