# One interface target that carries the warnings of the project's own code.
add_library(radiometry_warnings INTERFACE)
target_compile_options(radiometry_warnings INTERFACE
  $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-Wall;-Wextra;-Wshadow;-Wno-unused-parameter>)
if (VTKRADIOMETRY_WARNINGS_AS_ERRORS)
  target_compile_options(radiometry_warnings INTERFACE
    $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-Werror>)
endif ()
