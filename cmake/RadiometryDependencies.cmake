# Everything that comes from outside, in one place.
find_package(embree CONFIG REQUIRED)       # target embree (versions 3 and 4 both carry this name)
find_package(TBB CONFIG REQUIRED)          # TBB::tbb
find_package(Eigen3 CONFIG REQUIRED)       # Eigen3::Eigen
find_package(OpenEXR CONFIG REQUIRED)      # OpenEXR::OpenEXR
find_package(nlohmann_json CONFIG REQUIRED)
find_package(TinyGLTF CONFIG REQUIRED)    # TinyGLTF::TinyGLTF (Debian: libtinygltf-dev)

# Debian's OpenColorIOConfig.cmake names targets that it does not ship (2.1.2): use pkg-config.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OCIO REQUIRED IMPORTED_TARGET GLOBAL OpenColorIO>=2.1)

set(VTKRADIOMETRY_HAVE_PARAVIEW OFF)
if (VTKRADIOMETRY_USE_PARAVIEW)
  # Debian 13's ParaView 5.13 exports Python targets under names that its files do not have; the
  # variables below switch that check off (CMake 3.28 and later) and do nothing elsewhere.
  file(GLOB _pv_python_targets
    "/usr/lib/*/cmake/paraview-*/vtk/VTKPython-targets-*.cmake"
    "/usr/lib/*/cmake/paraview-*/ParaViewPython*-targets-*.cmake")
  foreach (_file IN LISTS _pv_python_targets)
    file(STRINGS "${_file}" _lines REGEX "_cmake_import_check_targets")
    string(REGEX MATCHALL "[A-Za-z0-9_]+::[A-Za-z0-9_]+" _names "${_lines}")
    foreach (_name IN LISTS _names)
      set("_cmake_import_check_xcframework_for_${_name}" "${CMAKE_SOURCE_DIR}")
    endforeach ()
  endforeach ()
  # Without COMPONENTS, paraview-dev wants some forty more -dev packages.
  find_package(ParaView QUIET COMPONENTS RemotingViews RemotingApplication)
  if (ParaView_FOUND)
    set(VTKRADIOMETRY_HAVE_PARAVIEW ON)
  endif ()
endif ()
if (NOT VTKRADIOMETRY_HAVE_PARAVIEW)
  find_package(VTK REQUIRED COMPONENTS
    CommonCore CommonDataModel CommonExecutionModel CommonTransforms FiltersCore FiltersGeneral
    FiltersGeometry IOGeometry IOImage IOXML RenderingCore RenderingOpenGL2 InteractionStyle glew
    Python WrappingPythonCore)
endif ()
message(STATUS "vtkRadiometry: ParaView ${VTKRADIOMETRY_HAVE_PARAVIEW} ${ParaView_VERSION}, "
  "VTK ${VTK_VERSION}, Embree ${embree_VERSION}, OpenColorIO ${OCIO_VERSION}, "
  "OpenEXR ${OpenEXR_VERSION}")
