// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: what a radiometric array is called in photometry.
#ifndef PhotometricNames_h
#define PhotometricNames_h

#include <string>

/// A quantity and its photometric counterpart, with the latter's unit.
struct Photometry
{
  const char* Radiometric;
  const char* Photometric;
  const char* Unit;
};

/// The photometric counterpart of a quantity, "IrradianceBack" included, and its name in `renamed`;
/// null: none.
const Photometry* Counterpart(const std::string& name, std::string& renamed);

#endif
