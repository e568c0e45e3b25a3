// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

/// Where and of what a benchmark's figures are.
namespace benchmark
{

/// What a file of /proc says behind `key`; "0" when nothing.
inline std::string SystemField(const char* path, const std::string& key)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind(key, 0) == 0)
    {
      return line.substr(line.find(':') + 2);
    }
  }
  return "0";
}

/// Commit of the current folder, processor and the load that was met.
inline void AddProvenance(nlohmann::json& out)
{
  char text[64] = "";
  if (FILE* pipe = popen("git rev-parse --short HEAD 2>/dev/null", "r"))
  {
    if (!std::fgets(text, sizeof text, pipe))
    {
      text[0] = 0;
    }
    pclose(pipe);
  }
  const std::string commit(text);
  out["commit"] = commit.substr(0, commit.find('\n'));
  out["processor"] = SystemField("/proc/cpuinfo", "model name");
  double load[1] = { 0.0 };
  out["load"] = getloadavg(load, 1) == 1 ? load[0] : 0.0;
}

} // namespace benchmark
