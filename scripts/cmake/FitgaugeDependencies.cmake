# The libraries fitgauge takes from Debian 12. Each is looked up when a layer asks for it; one that is
# missing is named together with the package that has it.

# fitgauge_need(<CMake package> <Debian package> [find_package arguments])
macro(fitgauge_need package debian)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR
      "fitgauge needs ${package}: install it with `apt-get install ${debian}`, "
      "or everything at once with scripts/install.")
  endif()
endmacro()

# fitgauge_need_library(<library> <header> <Debian package>): one that brings no CMake package; links as <library>::<library>.
function(fitgauge_need_library library header debian)
  find_path(${library}_include ${header})
  find_library(${library}_library ${library})
  if(NOT ${library}_include OR NOT ${library}_library)
    message(FATAL_ERROR
      "fitgauge needs ${library}: install it with `apt-get install ${debian}`, "
      "or everything at once with scripts/install.")
  endif()
  add_library(${library}::${library} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(${library}::${library} PROPERTIES
    IMPORTED_LOCATION "${${library}_library}" INTERFACE_INCLUDE_DIRECTORIES "${${library}_include}")
endfunction()

# Boost.System is header-only; base builds its Result on it.
fitgauge_need(Boost libboost1.81-dev 1.81)
fitgauge_need(fmt libfmt-dev)
fitgauge_need(Threads libc6-dev)
