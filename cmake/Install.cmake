# What an installed copy needs beside libraries and headers: the shipped files and PartwiseConfig.cmake, which
# find_package(Partwise COMPONENTS room...) reads. Included after all rooms are known.
include(CMakePackageConfigHelpers)
get_property(PARTWISE_ROOMS GLOBAL PROPERTY PARTWISE_ROOMS)
get_property(PARTWISE_ROOM_FACTS GLOBAL PROPERTY PARTWISE_ROOM_FACTS)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/PartwiseConfig.cmake.in ${PROJECT_BINARY_DIR}/PartwiseConfig.cmake
                              INSTALL_DESTINATION ${PARTWISE_INSTALL_CMAKE} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PartwiseConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PartwiseConfig.cmake ${PROJECT_BINARY_DIR}/PartwiseConfigVersion.cmake
        ${CMAKE_CURRENT_LIST_DIR}/eigen_symbols.map
        DESTINATION ${PARTWISE_INSTALL_CMAKE} COMPONENT dev)
install(DIRECTORY data DESTINATION ${PARTWISE_INSTALL_SHARE} COMPONENT shared PATTERN "*corpus" EXCLUDE)  # these are for tests only
install(DIRECTORY models DESTINATION ${PARTWISE_INSTALL_SHARE} COMPONENT shared)
install(FILES LICENSE NOTICE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT shared)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT shared)
