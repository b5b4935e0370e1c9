# PALPATE_THREADS_CORE names a palpate_core library that is built already. Then palpate_threads can be built
# (scripts/checks/check_threads.sh): what shares work between threads, with its tests, by ThreadSanitizer; all else
# is taken from there, so that it takes two minutes in place of hours.
set(PALPATE_THREADS_CORE "" CACHE FILEPATH "For palpate_threads: a core that is built already")

if(PALPATE_THREADS_CORE)
  add_compile_options(-O1 -g1 -fno-omit-frame-pointer -fsanitize=thread)
  add_link_options(-fsanitize=thread)
endif()
