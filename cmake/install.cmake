# The command and what its users read. The library stays uninstalled until its interface is stable.
include(GNUInstallDirs)
install(TARGETS flexura_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs examples schema DESTINATION ${CMAKE_INSTALL_DOCDIR})
