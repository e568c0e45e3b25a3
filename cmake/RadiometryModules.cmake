# The VTK modules, their Python wrapping and the ParaView plugin.
set(_module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/filters/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/rendering/vtk.module")
set(_modules vtkRadiometry::Filters vtkRadiometry::Rendering)
if (VTKRADIOMETRY_HAVE_PARAVIEW)
  list(APPEND _module_files "${CMAKE_CURRENT_SOURCE_DIR}/rendering/paraview/vtk.module")
  list(APPEND _modules vtkRadiometry::RenderingParaView)
endif ()

vtk_module_scan(
  MODULE_FILES ${_module_files}
  REQUEST_MODULES ${_modules}
  PROVIDES_MODULES provided
  REQUIRES_MODULES required
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${provided}
  PACKAGE vtkRadiometry
  INSTALL_EXPORT vtkRadiometry
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/vtkRadiometry"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/vtkRadiometry")

set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "The Python that VTK was built for")
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
set(VTKRADIOMETRY_PYTHON_DESTINATION "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
vtk_module_wrap_python(
  MODULES ${provided}
  TARGET vtkRadiometry::PythonWrapped
  PYTHON_PACKAGE vtkradiometry
  MODULE_DESTINATION "${VTKRADIOMETRY_PYTHON_DESTINATION}"
  INSTALL_HEADERS OFF)
add_subdirectory(python)

if (VTKRADIOMETRY_HAVE_PARAVIEW)
  paraview_plugin_scan(
    PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/plugin/paraview.plugin"
    PROVIDES_PLUGINS plugins
    ENABLE_BY_DEFAULT ON
    HIDE_PLUGINS_FROM_CACHE ON)
  paraview_plugin_build(
    PLUGINS ${plugins}
    PLUGINS_FILE_NAME "vtkRadiometry.plugins.xml"
    LIBRARY_SUBDIRECTORY "paraview/plugins")
endif ()
