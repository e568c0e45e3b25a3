# Debian 13's ParaView 5.13 exports Python targets under names that its files do not have, a fatal
# error inside find_package(ParaView). The variables below switch that check off (CMake 3.28 and
# later) and do nothing elsewhere. Also installed, for vtkRadiometryConfig.cmake.
file(GLOB _radiometry_files
  "/usr/lib/*/cmake/paraview-*/vtk/VTKPython-targets-*.cmake"
  "/usr/lib/*/cmake/paraview-*/ParaViewPython*-targets-*.cmake")
foreach (_radiometry_file IN LISTS _radiometry_files)
  file(STRINGS "${_radiometry_file}" _radiometry_lines REGEX "_cmake_import_check_targets")
  string(REGEX MATCHALL "[A-Za-z0-9_]+::[A-Za-z0-9_]+" _radiometry_names "${_radiometry_lines}")
  foreach (_radiometry_name IN LISTS _radiometry_names)
    set("_cmake_import_check_xcframework_for_${_radiometry_name}" "${CMAKE_CURRENT_LIST_DIR}")
  endforeach ()
endforeach ()
