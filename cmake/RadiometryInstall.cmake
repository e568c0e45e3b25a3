# What `cmake --install` adds to the libraries: headers of the core and the CMake package, so that
#   find_package(vtkRadiometry)
#   target_link_libraries(program PRIVATE vtkRadiometry::Filters vtkRadiometry::radiometry)
# works (the VTK or ParaView that this was built with is found by the package itself).
include(CMakePackageConfigHelpers)
set(_destination "${CMAKE_INSTALL_LIBDIR}/cmake/vtkRadiometry")

install(EXPORT radiometryCore
  NAMESPACE vtkRadiometry::
  FILE vtkRadiometry-core-targets.cmake
  DESTINATION "${_destination}")
export(EXPORT radiometryCore
  NAMESPACE vtkRadiometry::
  FILE "${CMAKE_BINARY_DIR}/${_destination}/vtkRadiometry-core-targets.cmake")
foreach (_folder radiometry color io)
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/${_folder}/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/vtkRadiometry/${_folder}"
    FILES_MATCHING PATTERN "*.h")
endforeach ()
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/vtkRadiometryConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${_destination}/vtkRadiometryConfig.cmake"
  INSTALL_DESTINATION "${_destination}")
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${_destination}/vtkRadiometryConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
configure_file("${CMAKE_CURRENT_LIST_DIR}/RadiometryDebianParaView.cmake"
  "${CMAKE_BINARY_DIR}/${_destination}/RadiometryDebianParaView.cmake" COPYONLY)
install(FILES
  "${CMAKE_BINARY_DIR}/${_destination}/RadiometryDebianParaView.cmake"
  "${CMAKE_BINARY_DIR}/${_destination}/vtkRadiometryConfig.cmake"
  "${CMAKE_BINARY_DIR}/${_destination}/vtkRadiometryConfigVersion.cmake"
  DESTINATION "${_destination}")
install(FILES LICENSE README.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
