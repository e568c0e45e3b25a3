# What ./run builds and where it finds it.
#
# The target `runtime` is everything a user runs: libraries, wrapped modules, the plugin; no tests.
# build/environment.sh tells the scripts the folders.
set(_runtime radiometry)
foreach (_module IN LISTS provided)
  string(REPLACE "vtkRadiometry::" "vtkRadiometry" _python "${_module}Python")
  if (TARGET "${_python}")
    list(APPEND _runtime "${_python}")
  endif ()
endforeach ()
if (TARGET Radiometry)
  list(APPEND _runtime Radiometry)
endif ()
add_custom_target(runtime DEPENDS ${_runtime})

file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/environment.sh" @ONLY CONTENT
"# Written by CMake for ./run and ./test.
VTKRADIOMETRY_PYTHONPATH='@CMAKE_BINARY_DIR@/@VTKRADIOMETRY_PYTHON_DESTINATION@'
VTKRADIOMETRY_PLUGIN_PATH='@CMAKE_BINARY_DIR@/@CMAKE_INSTALL_LIBDIR@/paraview/plugins/Radiometry'
")
