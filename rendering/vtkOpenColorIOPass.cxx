// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenColorIOPass.h"

#include "DisplayPassParts.h"
#include "color/ColorTransform.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace color = radiometry::color;

namespace
{

/// The name that glsl/vtkLinearFloatShowFS.glsl calls the transform by.
const char* const functionName = "radiometryToDisplay";

} // namespace

struct vtkOpenColorIOPass::Internals
{
  std::unique_ptr<color::ColorTransform> Transform; // null: the picture is shown as it is
  color::GpuShader Shader;
  std::vector<vtkSmartPointer<vtkTextureObject>> Tables;
  std::string Names; // what the above was built from; empty: nothing yet
  std::string Error;
  std::string Reported; // the names that an error was reported of last

  void Rebuild(vtkOpenColorIOPass* self, vtkOpenGLRenderWindow* window);
};

vtkStandardNewMacro(vtkOpenColorIOPass);

//------------------------------------------------------------------------------
vtkOpenColorIOPass::vtkOpenColorIOPass()
  : Data(new Internals)
{
}

vtkOpenColorIOPass::~vtkOpenColorIOPass() = default;

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ConfigFileName: " << this->ConfigFileName << "\n"
     << indent << "SourceColorSpace: " << this->SourceColorSpace << "\n"
     << indent << "Display: " << this->Display << "\n"
     << indent << "View: " << this->View << "\n"
     << indent << "Look: " << this->Look << "\n"
     << indent << "Exposure: " << this->Exposure << "\n";
}

//------------------------------------------------------------------------------
std::string vtkOpenColorIOPass::GetErrorMessage() const { return this->Data->Error; }

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::Rebuild(vtkOpenColorIOPass* self, vtkOpenGLRenderWindow* window)
{
  const char* environment = std::getenv("OCIO");
  const std::string config = self->ConfigFileName.empty() && environment
    ? std::string("$OCIO ") + environment
    : self->ConfigFileName;
  const std::string names = config + '\n' + self->SourceColorSpace + '\n' +
    self->Display + '\n' + self->View + '\n' + self->Look +
    (std::isfinite(self->Exposure) ? "" : "\nexposure");
  const bool same = names == this->Names;
  if (!same)
  {
    this->Tables.clear();
    this->Transform.reset();
    this->Shader = {};
    std::string error;
    try
    {
      const color::TransformOptions options{ self->SourceColorSpace, "", self->Display, self->View,
        self->Look, self->Exposure };
      this->Transform = std::make_unique<color::ColorTransform>(
        color::ColorConfig::Open(self->ConfigFileName), options);
      this->Shader = this->Transform->Shader(functionName, "radiometry_ocio_");
      for (const color::GpuTexture& texture : this->Shader.Textures)
      {
        this->Tables.push_back(displaypass::Upload(window, texture));
      }
    }
    catch (const color::ColorError& e)
    {
      this->Transform.reset();
      this->Shader = {};
      this->Tables.clear();
      error = e.what();
    }
    const bool report = !error.empty() && names != this->Reported;
    this->Error = error;
    this->Names = names;
    this->Reported = error.empty() ? std::string() : names;
    if (report)
    {
      vtkErrorWithObjectMacro(self, << error << "; the linear picture is shown as it is.");
    }
  }
  for (color::GpuUniform& uniform : this->Shader.Uniforms)
  {
    uniform.Value = self->Exposure;
  }
}

//------------------------------------------------------------------------------
std::string vtkOpenColorIOPass::DisplayFunction(vtkOpenGLRenderWindow* window)
{
  this->Data->Rebuild(this, window);
  return this->Data->Transform ? this->Data->Shader.Text
                               : this->Superclass::DisplayFunction(window);
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::StartDisplay(vtkShaderProgram* program)
{
  for (std::size_t i = 0; i < this->Data->Tables.size(); ++i)
  {
    this->Data->Tables[i]->Activate();
    program->SetUniformi(
      this->Data->Shader.Textures[i].Sampler.c_str(), this->Data->Tables[i]->GetTextureUnit());
  }
  for (const color::GpuUniform& uniform : this->Data->Shader.Uniforms)
  {
    program->SetUniformf(uniform.Name.c_str(), static_cast<float>(uniform.Value));
  }
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::FinishDisplay()
{
  for (const auto& texture : this->Data->Tables)
  {
    texture->Deactivate();
  }
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  for (const auto& texture : this->Data->Tables)
  {
    texture->ReleaseGraphicsResources(window);
  }
  this->Data->Tables.clear();
  this->Data->Names.clear();
}
