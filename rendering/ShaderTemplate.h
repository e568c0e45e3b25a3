// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShaderTemplate_h
#define ShaderTemplate_h

#include <set>
#include <string>

namespace vtkradiometry
{

/// Names of what a shader has to do. Sorted, so that the same needs give the same text.
using ShaderFeatures = std::set<std::string>;

/// Expands a .glsl file of rendering/glsl: keeps of it what `features` asks for.
///   //@if A        the lines up to //@else or //@end stay when A is among the features
///   //@if !A       ... when it is not
/// Blocks nest. Lines that are comments only are dropped, so that the text that is compiled holds
/// code and nothing else.
///   Fails   std::logic_error for a directive without its partner (a defect of the file)
std::string ExpandShader(const char* text, const ShaderFeatures& features);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: ShaderTemplate.h
