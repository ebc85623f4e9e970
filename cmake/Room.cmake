# partwise_room(NAME DIRS dir... [LINK target...] [PRIVATE target...] [HEADERS target...] [PACKAGES package...]
#               [TEST_LINK target...])
# A room of the library: every .cpp of its folders, less the tests, becomes the static library partwise_NAME
# (alias Partwise::NAME); every *_test.cpp becomes the one test program NAME_tests, which ctest lists test by test.
# LINK is part of the room's interface, PRIVATE is linked only, HEADERS are header-only libraries that are gone once the
# room is compiled. PACKAGES are what find_package(Partwise) has to find for whoever links the installed room.
function(partwise_room name)
  cmake_parse_arguments(ROOM "" "" "DIRS;LINK;PRIVATE;HEADERS;PACKAGES;TEST_LINK" ${ARGN})
  set(sources)
  set(tests)
  foreach(dir IN LISTS ROOM_DIRS)
    file(GLOB dir_sources CONFIGURE_DEPENDS ${dir}/*.cpp)
    file(GLOB dir_tests CONFIGURE_DEPENDS ${dir}/*_test.cpp)
    list(APPEND sources ${dir_sources})
    list(APPEND tests ${dir_tests})
  endforeach()
  if(tests)
    list(REMOVE_ITEM sources ${tests})
  endif()
  add_library(partwise_${name} STATIC ${sources})
  add_library(Partwise::${name} ALIAS partwise_${name})
  set_target_properties(partwise_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(partwise_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(partwise_${name} PUBLIC cxx_std_20)
  target_link_libraries(partwise_${name} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE} $<BUILD_INTERFACE:partwise_flags>)
  foreach(header_only IN LISTS ROOM_HEADERS)
    target_link_libraries(partwise_${name} PRIVATE $<BUILD_INTERFACE:${header_only}>)
  endforeach()
  partwise_install_room(${name})
  if(PARTWISE_TESTS AND tests)
    add_executable(${name}_tests ${tests})
    target_link_libraries(${name}_tests PRIVATE partwise_${name} ${ROOM_TEST_LINK} partwise_flags GTest::gtest_main GTest::gmock)
    target_compile_definitions(${name}_tests PRIVATE PARTWISE_TEST_DATA="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(${name}_tests TEST_PREFIX ${name}/ DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

# Part of partwise_room: installs the library and its headers, and notes what PartwiseConfig.cmake must say about the room.
function(partwise_install_room name)
  install(TARGETS partwise_${name} EXPORT Partwise-${name})
  install(EXPORT Partwise-${name} NAMESPACE Partwise:: DESTINATION ${PARTWISE_INSTALL_CMAKE})
  foreach(dir IN LISTS ROOM_DIRS)
    install(DIRECTORY ${dir}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/partwise/${dir}
            OPTIONAL FILES_MATCHING PATTERN "*.h" PATTERN "test_*" EXCLUDE)
  endforeach()
  set(below ${ROOM_LINK} ${ROOM_PRIVATE})
  list(FILTER below INCLUDE REGEX "^Partwise::")
  list(TRANSFORM below REPLACE "^Partwise::" "")
  set_property(GLOBAL APPEND PROPERTY PARTWISE_ROOMS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY PARTWISE_ROOM_FACTS
               "set(_partwise_below_${name} ${below})\nset(_partwise_packages_${name} ${ROOM_PACKAGES})\n")
endfunction()
