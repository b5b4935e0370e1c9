# Warnings that are held at zero, by GCC 12. .ci/run has one of them end the build; other builds go on,
# for another compiler may warn of something else.
option(PALPATE_WARNINGS_AS_ERRORS "A warning of one of our own sources ends the build" OFF)

function(palpate_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow
    $<$<BOOL:${PALPATE_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# The core's too: a number that another type may not hold is converted by a cast, where one can see it.
# An int that counts or indexes is no such number; GCC leaves it alone, clang-tidy's compiler does not.
function(palpate_core_warnings target)
  palpate_warnings(${target})
  target_compile_options(${target} PRIVATE -Wconversion -Wno-sign-conversion)
endfunction()
