// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: the field data Wavelengths of a simulation's inputs.
#ifndef BandWavelengths_h
#define BandWavelengths_h

#include <vector>

class vtkDataObject;

/// The centres of the bands [nm] that one of the objects states (itself, or a block of it); empty where
/// none does.
/// Fails: InputError{Wavelengths} where two statements differ.
std::vector<double> FindWavelengths(const std::vector<vtkDataObject*>& objects);

/// The same, held against the number of bands of the scene.
/// Fails: InputError{Wavelengths} for another number, and as radiometry::imaging::SpectralColor.
std::vector<double> CheckedWavelengths(const std::vector<vtkDataObject*>& objects, int bands);

/// States them on an output that does not.
void AddWavelengths(const std::vector<double>& wavelengths, vtkDataObject* output);

#endif
