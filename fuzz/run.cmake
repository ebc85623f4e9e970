# Runs one fuzzed reader: the seeds of its format among the shipped files, what earlier runs kept, then new ones.
file(GLOB seeds ${DATA}/outlines/*.${FORMAT} ${DATA}/outline_corpus/*.${FORMAT} ${DATA}/image_corpus/*.${FORMAT} ${DATA}/material_corpus/*.${FORMAT})
file(MAKE_DIRECTORY ${FOLDER}/seeds ${FOLDER}/found)
if(seeds)
  file(COPY ${seeds} DESTINATION ${FOLDER}/seeds)
endif()
execute_process(COMMAND ${PROGRAM} -max_total_time=${SECONDS} -max_len=8192 -timeout=20 -rss_limit_mb=2048 -seed=1
                        -print_final_stats=1 -artifact_prefix=${FOLDER}/ ${FOLDER}/found ${FOLDER}/seeds
                RESULT_VARIABLE result ERROR_VARIABLE text)
string(LENGTH "${text}" length)
math(EXPR from "${length} - 6000")
if(from GREATER 0)
  string(SUBSTRING "${text}" ${from} -1 text)
endif()
message("${text}")
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} found a fault (${result}); its input lies in ${FOLDER}")
endif()
