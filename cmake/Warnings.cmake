# One interface target with what every target of the project is compiled with.
add_library(partwise_flags INTERFACE)
target_compile_options(partwise_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-array-bounds
                       -Wno-stringop-overread)  # GCC 12 sees ghosts in Eigen's vectorised copies
if(PARTWISE_ARCH)
  target_compile_options(partwise_flags INTERFACE -march=${PARTWISE_ARCH})
endif()
# Contraction off: the same source gives the same bits whatever the compiler fuses.
target_compile_options(partwise_flags INTERFACE -ffp-contract=off)
if(PARTWISE_SANITIZE)
  target_compile_options(partwise_flags INTERFACE -fsanitize=${PARTWISE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(partwise_flags INTERFACE -fsanitize=${PARTWISE_SANITIZE})
endif()
