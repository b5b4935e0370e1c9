# palpate_precompile(TARGET [HEADER ...]): headers of libraries that the target's sources read from a
# precompiled form, which saves most of their compile time: those listed here and the given ones.
#
# A source still includes all it needs, so that it compiles without: CMAKE_DISABLE_PRECOMPILE_HEADERS
# turns this off, and clang-tidy never sees it. No header of our
# own belongs here, or a change of it would compile everything anew; <iostream> neither, which adds
# its initialisation to every object.
set(palpate_precompiled_headers
  <Eigen/Dense> <Eigen/SparseCholesky> <Eigen/SparseCore>
  <algorithm> <array> <atomic> <cmath> <cstddef> <cstdint> <cstdio> <cstdlib> <cstring>
  <filesystem> <fstream> <functional> <iomanip> <iterator> <limits> <map> <memory> <mutex>
  <numeric> <optional> <random> <set> <sstream> <stdexcept> <string> <string_view> <thread>
  <tuple> <type_traits> <unordered_map> <utility> <variant> <vector>)

function(palpate_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN} ${palpate_precompiled_headers})
endfunction()
