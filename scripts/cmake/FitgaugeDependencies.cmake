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

# Boost.System is header-only; base builds its Result on it.
fitgauge_need(Boost libboost1.81-dev 1.81)
fitgauge_need(fmt libfmt-dev)
fitgauge_need(Threads libc6-dev)
