include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(LIGHTWELL_CCACHE ccache)
if(LIGHTWELL_CCACHE)
    # Without this sloppiness ccache keeps nothing that uses precompiled headers.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${LIGHTWELL_CCACHE})
endif()

# What every target is compiled with. -ffp-contract=off: the same bits whether or not the processor can fuse a
# multiply and an add; -fno-math-errno, -fno-trapping-math: let the square root be one instruction.
add_library(lightwell_flags INTERFACE)
target_compile_options(lightwell_flags INTERFACE
    -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Werror -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(LIGHTWELL_SANITIZE)
    # g++ 12 warns of values that are not there (std::optional, std::string +) in the code its own checks are added to.
    target_compile_options(lightwell_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
        -Wno-maybe-uninitialized -Wno-restrict)
    target_link_options(lightwell_flags INTERFACE -fsanitize=address,undefined)
endif()
if(LIGHTWELL_FUZZ)
    # The compiler of the fuzzers is another one than the house's: its warnings are no errors. Assertions are on.
    target_compile_options(lightwell_flags INTERFACE -fsanitize=address,undefined,fuzzer-no-link
        -fno-sanitize-recover=all -UNDEBUG -Wno-error)
    target_link_options(lightwell_flags INTERFACE -fsanitize=address,undefined)
endif()

# The standard library's headers, compiled once for all libraries: they are half the time of a small file.
file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "")
add_library(lightwell_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(lightwell_precompiled PRIVATE lightwell_flags)
target_precompile_headers(lightwell_precompiled PRIVATE <algorithm> <array> <cmath> <filesystem> <fstream> <functional>
    <map> <memory> <optional> <set> <span> <sstream> <string> <string_view> <unordered_map> <variant> <vector>)

# lightwell_library(NAME SOURCES file... USES folder-target... HIDES package-target...)
#   USES   the folders whose headers this one includes; tests/structure holds the includes to it
#   HIDES  outside packages; they are linked privately and appear in no header of the folder
#   PRECOMPILE  headers to compile once for this folder, in place of those that all libraries share
function(lightwell_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;USES;HIDES;PRECOMPILE" ${ARGN})
    list(TRANSFORM ARG_USES PREPEND lightwell_)
    if(ARG_SOURCES)
        add_library(lightwell_${name} STATIC ${ARG_SOURCES})
        target_include_directories(lightwell_${name} PUBLIC ${PROJECT_SOURCE_DIR})
        target_link_libraries(lightwell_${name} PUBLIC ${ARG_USES} PRIVATE lightwell_flags ${ARG_HIDES})
        if(ARG_PRECOMPILE)
            target_precompile_headers(lightwell_${name} PRIVATE ${ARG_PRECOMPILE})
        else()
            target_precompile_headers(lightwell_${name} REUSE_FROM lightwell_precompiled)
        endif()
    else() # headers only
        add_library(lightwell_${name} INTERFACE)
        target_include_directories(lightwell_${name} INTERFACE ${PROJECT_SOURCE_DIR})
        target_link_libraries(lightwell_${name} INTERFACE ${ARG_USES})
    endif()
endfunction()
