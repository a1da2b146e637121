# Debian packages, by `cpack -G DEB` in the build folder (docs/installation.md): flexura with the
# command, libflexura-dev with the library.
set(CPACK_PACKAGE_NAME flexura)
set(CPACK_PACKAGE_CONTACT "Flexura developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL command development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME flexura)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
# The project's description comes first, as the short one.
set(CPACK_DEBIAN_COMMAND_DESCRIPTION
    "Flexura analyses flexure stages, grippers, monolithic four-bars, bistable
beams and elastic linkages; at rest, vibrating and in motion. One model file
goes in; every modeling the field knows comes out side by side, as CSV and JSON
files and as one HTML report.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libflexura-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What flexuraConfig.cmake looks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libtomlplusplus-dev, libmuparser-dev, \
libtbb-dev, liblapack-dev, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "The static library and headers of Flexura, which reads models of compliant
mechanisms and elastic linkages, runs their studies and writes results. For
CMake: find_package(flexura).")

include(CPack)
