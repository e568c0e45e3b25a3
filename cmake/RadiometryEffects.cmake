# Builds of the core without some of its effects (radiometry/effects/CompiledEffects.h).
set(VTKRADIOMETRY_EFFECTS_LEFT_OUT "" CACHE STRING
  "Effects that the core is compiled without, by their names in EffectPlan.h; a list")

# radiometry_leave_effects_out(TARGET [effects ...]): compiles the sources of a target without them.
function (radiometry_leave_effects_out target)
  if (ARGN)
    list(TRANSFORM ARGN PREPEND "Effect::" OUTPUT_VARIABLE _effects)
    list(JOIN _effects "," _effects)
    target_compile_definitions(${target} PRIVATE "RADIOMETRY_EFFECTS_LEFT_OUT=${_effects}")
  endif ()
endfunction ()

# radiometry_add_with_core(NAME SOURCES ... LEFT_OUT [effects ...]): an executable that holds the core
# itself, compiled without these effects. Only the sources that ask for compiled effects are compiled
# once more; the others' objects are those of the library.
function (radiometry_add_with_core name)
  cmake_parse_arguments(arg "" "" "SOURCES;LEFT_OUT" ${ARGN})
  set(_objects "$<TARGET_OBJECTS:radiometry>")
  set(_again)
  if (arg_LEFT_OUT)
    get_target_property(_sources radiometry SOURCES)
    foreach (_source IN LISTS _sources)
      file(STRINGS "${CMAKE_SOURCE_DIR}/radiometry/${_source}" _asks
        REGEX "radiometry/effects/CompiledEffects.h" LIMIT_COUNT 1)
      if (_asks)
        list(APPEND _again "${CMAKE_SOURCE_DIR}/radiometry/${_source}")
        string(REPLACE "." "\\." _pattern "/${_source}")
        set(_objects "$<FILTER:${_objects},EXCLUDE,${_pattern}>")
      endif ()
    endforeach ()
  endif ()
  add_executable(${name} ${arg_SOURCES} ${_again} ${_objects})
  radiometry_leave_effects_out(${name} ${arg_LEFT_OUT})
  target_include_directories(${name} PRIVATE "${CMAKE_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE embree TBB::tbb Eigen3::Eigen radiometry_warnings)
endfunction ()

# The effects that a plain scene, surfaces in point light, does not have.
set(RADIOMETRY_OPTIONAL_EFFECTS
  AreaLights Attenuation BackFaces CandelaWebs DirectionalLights Emission Environment GlobalAmbient
  Mirrors SpecularTransport SpotLights SpotShape Transmission)
