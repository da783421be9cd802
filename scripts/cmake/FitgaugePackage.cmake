# `cmake --install` and, by scripts/package, a Debian package: programs, manual pages, completions, unit file.
include(GNUInstallDirs)

install(TARGETS fitgauged fitgauge RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(FILES clients/cli/completion/fitgauge.bash
  DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME fitgauge)

# The program writes those of other shells itself, of the options it has.
set(package_files "${CMAKE_BINARY_DIR}/package")
file(MAKE_DIRECTORY "${package_files}")
string(REPLACE ";" " " emulator "${CMAKE_CROSSCOMPILING_EMULATOR}")
function(install_completion shell file folder)
  install(CODE "execute_process(COMMAND ${emulator} \"$<TARGET_FILE:fitgauge>\" completion ${shell}
    OUTPUT_FILE \"${package_files}/${file}\" COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES "${package_files}/${file}" DESTINATION "${CMAKE_INSTALL_DATADIR}/${folder}")
endfunction()
install_completion(zsh _fitgauge zsh/vendor-completions)
install_completion(fish fitgauge.fish fish/vendor_completions.d)

# The unit names the binary where it is installed.
set(FITGAUGE_UNIT_DIR "lib/systemd/system" CACHE STRING "Where the systemd unit is installed")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  docs/deploy/fitgauged.service docs/man/fitgauge.1 docs/man/fitgauged.8 CHANGELOG.md docs/deploy/debian/changelog)
file(READ docs/deploy/fitgauged.service unit)
string(REPLACE "/usr/local/bin" "${CMAKE_INSTALL_FULL_BINDIR}" unit "${unit}")
string(REGEX REPLACE "^# Install:[^[]*" "" unit "${unit}")
file(WRITE "${package_files}/fitgauged.service" "${unit}")
install(FILES "${package_files}/fitgauged.service" DESTINATION "${FITGAUGE_UNIT_DIR}")

# install_compressed(<file> <folder> <name>): gzip without a time, so that the same input gives the same bytes.
function(install_compressed file folder name)
  execute_process(COMMAND gzip -9 -n -c "${file}" OUTPUT_FILE "${package_files}/${name}.gz"
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}" COMMAND_ERROR_IS_FATAL ANY)
  install(FILES "${package_files}/${name}.gz" DESTINATION "${folder}")
endfunction()
install_compressed(docs/man/fitgauge.1 "${CMAKE_INSTALL_MANDIR}/man1" fitgauge.1)
install_compressed(docs/man/fitgauged.8 "${CMAKE_INSTALL_MANDIR}/man8" fitgauged.8)

install(FILES docs/deploy/alerts.yml docs/deploy/grafana-dashboard.json
  DESTINATION "${CMAKE_INSTALL_DATADIR}/fitgauge")
install_compressed(CHANGELOG.md "${CMAKE_INSTALL_DOCDIR}" changelog)
install_compressed(docs/deploy/debian/changelog "${CMAKE_INSTALL_DOCDIR}" changelog.Debian)
install(FILES docs/deploy/debian/copyright "${CMAKE_BINARY_DIR}/web/page/licences.txt" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

set(FITGAUGE_MAINTAINER "fitgauge maintainers <maintainers@fitgauge.example>"
  CACHE STRING "The maintainer of the Debian package")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fitgauge)
set(CPACK_PACKAGE_CONTACT "${FITGAUGE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "ISO 286 limits, gauging verdicts and probe programs as a service")
set(CPACK_PACKAGE_DESCRIPTION
"The service fitgauged looks up the limits of a designation such as 25 H7,
judges measured diameters, stores them in SQLite, and runs HEIDENHAIN probe
programs on a simulated machine. It has a REST API and a web page. fitgauge is
its command line.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "init-system-helpers (>= 1.54~), ca-certificates, tzdata")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${CMAKE_SOURCE_DIR}/docs/deploy/debian/postinst" "${CMAKE_SOURCE_DIR}/docs/deploy/debian/prerm"
  "${CMAKE_SOURCE_DIR}/docs/deploy/debian/postrm")
include(CPack)
