// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmarks/Provenance.h"

#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>

/// One size of a sweep in a process of its own, so that its peak of memory is its own.
namespace benchmark
{

/// VmRSS or VmHWM of this process in bytes.
inline double Resident(const char* which)
{
  return 1024.0 * std::atof(SystemField("/proc/self/status", which).c_str());
}

/// Runs `body` in a child and returns what it answers; { "failed": why } where it ended otherwise.
inline nlohmann::json Apart(const std::function<nlohmann::json()>& body)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("no pipe");
  }
  const pid_t child = fork();
  if (child == 0)
  {
    close(ends[0]);
    std::string text;
    try
    {
      text = body().dump();
    }
    catch (const std::exception& error)
    {
      text = nlohmann::json{ { "failed", error.what() } }.dump();
    }
    const bool written =
      write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(ends[1]);
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
  {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return status == 0 && !text.empty() ? nlohmann::json::parse(text)
                                      : nlohmann::json{ { "failed", "the process ended" } };
}

} // namespace benchmark
