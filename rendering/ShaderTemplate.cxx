// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderTemplate.h"

#include <sstream>
#include <stdexcept>
#include <vector>

namespace vtkradiometry
{

std::string ExpandShader(const char* text, const ShaderFeatures& features)
{
  std::istringstream lines(text);
  std::string line;
  std::string result;
  // For each open block: is this branch kept, given that all around it is?
  std::vector<bool> kept;
  const auto keeping = [&kept]() {
    for (const bool k : kept)
    {
      if (!k)
      {
        return false;
      }
    }
    return true;
  };
  while (std::getline(lines, line))
  {
    const std::size_t start = line.find_first_not_of(" \t");
    const std::string code = start == std::string::npos ? std::string() : line.substr(start);
    if (code.rfind("//@if ", 0) == 0)
    {
      std::string name = code.substr(6);
      const bool inverted = !name.empty() && name[0] == '!';
      name = inverted ? name.substr(1) : name;
      kept.push_back((features.count(name) != 0) != inverted);
    }
    else if (code == "//@else" || code == "//@end")
    {
      if (kept.empty())
      {
        throw std::logic_error(code + " without //@if in a shader");
      }
      if (code == "//@else")
      {
        kept.back() = !kept.back();
      }
      else
      {
        kept.pop_back();
      }
    }
    else if (keeping() && !code.empty() && code.rfind("//", 0) != 0)
    {
      result += line + "\n";
    }
  }
  if (!kept.empty())
  {
    throw std::logic_error("//@if without //@end in a shader");
  }
  return result;
}

} // namespace vtkradiometry
