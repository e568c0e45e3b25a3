// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiosityFilter_h
#define vtkRadiosityFilter_h

#include "vtkRadiometricFilter.h"

#include <memory> // for the cache

namespace radiometry
{
class RadiosityCache;
}

/// Direct light, emission and interreflection on a surface: irradiance and radiosity.
///   Reads   material arrays DiffuseReflectance, EmittedExitance, TwoSided; the light arrays
///           (docs/arrays.md)
///   Writes  Irradiance, Radiosity [W/m^2] and Radiance = Radiosity/pi [W/(m^2 sr)], each with its
///           Error; the same with Back where surfaces are two-sided   cell or point, N bands.
///           Field data RadiometryMethod: the operator used and why.
///           EffectPlan has five further rows with the parts of the error.
///   Model   B = M + rho E, E = E_lights + int F dB (diffuse)
///   Cost    Dense O(n^2) pairs, Hierarchical O(n) links, MonteCarlo O(n) rays; n elements
///   Fails   as vtkIrradianceFilter; a lossless closed cavity with light (no solution); a memory
///           limit too small for any method
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiosityFilter : public vtkRadiometricFilter
{
public:
  static vtkRadiosityFilter* New();
  vtkTypeMacro(vtkRadiosityFilter, vtkRadiometricFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of Method.
  enum Methods
  {
    METHOD_AUTO = 0,
    DENSE = 1,
    HIERARCHICAL = 2,
    MONTE_CARLO = 3
  };

  ///@{
  /// How light is exchanged between elements: 0 Auto (default), 1 Dense (all pairs, for some
  /// thousands of elements), 2 Hierarchical (links between clusters, for any number), 3 MonteCarlo
  /// (rays, for any number; they follow light over mirrors and through panes).
  vtkSetClampMacro(Method, int, METHOD_AUTO, MONTE_CARLO);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /// How often light is reflected at most: 0 (default) as often as it matters, n: n times exactly, so
  /// that 1 is direct light and what it sheds on other surfaces. What further reflections would add to
  /// any value is bounded in the effect plan, in the row Interreflection.
  vtkSetClampMacro(MaximumBounces, int, 0, 1000000);
  vtkGetMacro(MaximumBounces, int);
  ///@}

  ///@{
  /// Whether elements and the exchange between them are kept for the next execution. Default on:
  /// while points, cells, receiving sides and transmittances of surface and occluders stay the
  /// same, moving, dimming or recolouring lights, and changing diffuse reflectance or emission,
  /// only solves again. Such results may differ from those of a fresh filter within their errors,
  /// since they begin from elements that are finer where light was. What is kept counts towards
  /// MemoryLimit and is freed when geometry changes.
  vtkSetMacro(CacheOperator, bool);
  vtkGetMacro(CacheOperator, bool);
  vtkBooleanMacro(CacheOperator, bool);
  ///@}
  /// What is done with the file OperatorFile.
  enum OperatorFileModes
  {
    FILE_UNUSED = 0,
    SAVE_FILE = 1,
    LOAD_FILE = 2
  };
  ///@{
  /// File of the operator: elements and the exchange between them. Default: none. A part of its own,
  /// with the rank at the end of its name, for each of several ranks.
  vtkSetFilePathMacro(OperatorFile);
  vtkGetFilePathMacro(OperatorFile);
  ///@}
  ///@{
  /// 0 unused (default); 1 save: each execution writes the operator that it ended with; 2 load:
  /// executions begin from the file's. A file of other points, cells, sides, transmittances,
  /// occluders or options, of another version or damaged is an error that says which.
  vtkSetClampMacro(OperatorFileMode, int, FILE_UNUSED, LOAD_FILE);
  vtkGetMacro(OperatorFileMode, int);
  ///@}

  /// Frees what was kept.
  void ReleaseCache();
  /// What is kept now [MiB].
  double GetCacheMemory();

protected:
  vtkRadiosityFilter();
  ~vtkRadiosityFilter() override;

  void CopyMembers(vtkRadiometricAlgorithm* from) override;
  void Simulate(Job& job, Result& result) override;

  int Method = METHOD_AUTO;
  int MaximumBounces = 0;
  bool CacheOperator = true;
  char* OperatorFile = nullptr;
  int OperatorFileMode = FILE_UNUSED;

private:
  std::shared_ptr<radiometry::RadiosityCache> Cache;
  const void* CachedFor = nullptr; // the ranks that share what is kept

  vtkRadiosityFilter(const vtkRadiosityFilter&) = delete;
  void operator=(const vtkRadiosityFilter&) = delete;
};

#endif
