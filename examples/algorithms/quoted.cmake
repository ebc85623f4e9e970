# Fails unless PAGE holds the whole of CODE, word for word, as a block of C++.
file(READ ${CODE} code)
file(READ ${PAGE} page)
string(FIND "${page}" "```cpp\n${code}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "${PAGE} does not quote ${CODE} as it is")
endif()
