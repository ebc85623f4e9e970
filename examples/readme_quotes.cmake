# Fails unless README.md holds, word for word, what stands between the [README] marks of decompose.cpp.
file(READ ${CMAKE_CURRENT_LIST_DIR}/decompose.cpp source)
file(READ ${CMAKE_CURRENT_LIST_DIR}/../README.md readme)
string(REGEX MATCH "// \\[README\\]\n(.*)\n  // \\[README\\]" found "${source}")
string(REGEX REPLACE "(^|\n)  " "\\1" quotation "${CMAKE_MATCH_1}")
string(FIND "${readme}" "${quotation}" place)
if(NOT found OR place EQUAL -1)
  message(FATAL_ERROR "README.md does not quote examples/decompose.cpp as it is; it should read:\n${quotation}")
endif()
