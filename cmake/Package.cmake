# Debian packages, by `cpack` in the build folder: partwise, and apart from it what needs libtorch, the Python package,
# and libraries with headers. What they depend on is read off their libraries (dpkg-shlibdeps).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME partwise)
set(CPACK_PACKAGE_VENDOR Partwise)
set(CPACK_PACKAGE_CONTACT "The Partwise developers <partwise@localhost>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(processors)
if(PARTWISE_ARCH)
  set(processors "\nThe processor must be an ${PARTWISE_ARCH}.")
endif()

# partwise_package(GROUP NAME package SUMMARY line [COMPONENTS component...] [NEEDS dependency...] [WANTS package...])
# Of the group's components, which are the group itself if none are named, one package.
include(CPackComponent)
macro(partwise_package group)
  cmake_parse_arguments(PACKAGE "" "NAME;SUMMARY" "COMPONENTS;NEEDS;WANTS" ${ARGN})
  cpack_add_component_group(${group} DESCRIPTION "${PACKAGE_SUMMARY}")
  if(NOT PACKAGE_COMPONENTS)
    set(PACKAGE_COMPONENTS ${group})
  endif()
  foreach(component IN LISTS PACKAGE_COMPONENTS)
    cpack_add_component(${component} GROUP ${group})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
  endforeach()
  string(TOUPPER ${group} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${PACKAGE_NAME})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${PACKAGE_SUMMARY}${processors}")
  string(JOIN ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS ${PACKAGE_NEEDS})
  string(JOIN ", " CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS ${PACKAGE_WANTS})
endmacro()

set(same "partwise (= ${PROJECT_VERSION})")
partwise_package(program NAME partwise COMPONENTS program shared SUMMARY "The program, and the data and models that come with it"
                 WANTS partwise-learning)
if(PARTWISE_LEARNING)
  partwise_package(learning NAME partwise-learning NEEDS ${same} SUMMARY "The verbs of partwise that train networks or use them")
endif()
if(TARGET partwise_python)
  partwise_package(python NAME python3-partwise NEEDS ${same} "python3-numpy" WANTS python3-partwise-learning
                   SUMMARY "Parts, materials, pictures and roadmaps from Python")
  if(PARTWISE_LEARNING)
    partwise_package(python_learning NAME python3-partwise-learning NEEDS "python3-partwise (= ${PROJECT_VERSION})"
                     SUMMARY "Materials of photos edited, from Python")
  endif()
endif()
partwise_package(dev NAME libpartwise-dev WANTS libompl-dev libtorch-dev
                 NEEDS ${same} libeigen3-dev libtbb-dev libembree-dev libqhull-dev libgeos-dev libtinyxml2-dev libfmt-dev libpng-dev libjpeg-dev
                       libopenexr-dev libhdf5-dev coinor-libcbc-dev libarchive-dev libsvm-dev libfcl-dev libccd-dev
                 SUMMARY "Libraries of partwise, to be linked, with headers")
include(CPack)
