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
  include(RadiometryDebianParaView)
  # Without COMPONENTS, paraview-dev wants some forty more -dev packages.
  find_package(ParaView QUIET COMPONENTS RemotingViews RemotingApplication)
  if (ParaView_FOUND)
    set(VTKRADIOMETRY_HAVE_PARAVIEW ON)
  endif ()
endif ()
if (NOT VTKRADIOMETRY_HAVE_PARAVIEW)
  find_package(VTK REQUIRED COMPONENTS
    CommonCore CommonDataModel CommonExecutionModel CommonTransforms FiltersCore FiltersGeneral
    FiltersGeometry IOGeometry IOImage IOXML RenderingCore RenderingFreeType RenderingOpenGL2 InteractionStyle glew
    Python WrappingPythonCore)
endif ()
message(STATUS "vtkRadiometry: ParaView ${VTKRADIOMETRY_HAVE_PARAVIEW} ${ParaView_VERSION}, "
  "VTK ${VTK_VERSION}, Embree ${embree_VERSION}, OpenColorIO ${OCIO_VERSION}, "
  "OpenEXR ${OpenEXR_VERSION}")
