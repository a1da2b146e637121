# Two parts. `command`: the command and what its users read. `development`: the library, its
# headers, and what find_package(flexura) needs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS flexura_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(FILES LICENSE README.md CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
install(FILES cmake/debian_copyright
        DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT command)
install(DIRECTORY docs examples schema DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command
        PATTERN tables EXCLUDE PATTERN "*.results" EXCLUDE)

configure_file(apps/flexura/flexura.1.in flexura.1 @ONLY)
file(ARCHIVE_CREATE OUTPUT ${CMAKE_BINARY_DIR}/flexura.1.gz PATHS ${CMAKE_BINARY_DIR}/flexura.1
     FORMAT raw COMPRESSION GZip)
install(FILES ${CMAKE_BINARY_DIR}/flexura.1.gz
        DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)

install(TARGETS flexura EXPORT flexura COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY flexura DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp" PATTERN page EXCLUDE)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/flexura)
configure_package_config_file(cmake/flexuraConfig.cmake.in flexuraConfig.cmake
                              INSTALL_DESTINATION ${package_folder}
                              NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before 1.0 the library's interface may change with every minor version.
write_basic_package_version_file(flexuraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT flexura NAMESPACE flexura:: FILE flexuraTargets.cmake
        DESTINATION ${package_folder} COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/flexuraConfig.cmake ${CMAKE_BINARY_DIR}/flexuraConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)
