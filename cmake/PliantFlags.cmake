# Flags that every target of the project gets. -ffp-contract=off is part of the contract: fused multiply-adds would
# change the bits that laws give (docs/architecture.md: the same bits on every machine). Never -ffast-math.
function(pliant_set_flags target)
    target_compile_options(${target} PRIVATE
        -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
        $<$<BOOL:${PLIANT_WARNINGS_AS_ERRORS}>:-Werror>)
    # Vectors wider than the baseline never cross a function that is not inlined.
    target_compile_options(${target} PRIVATE
        -Wno-psabi $<$<CXX_COMPILER_ID:GNU>:-Wno-ignored-attributes>)
    # GCC 12 warns of overlaps in std::string operations that do not exist (its bug 105329).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
    if(PLIANT_SANITIZE)
        target_compile_options(${target} PUBLIC -fsanitize=${PLIANT_SANITIZE} -fno-omit-frame-pointer)
        target_link_options(${target} PUBLIC -fsanitize=${PLIANT_SANITIZE})
    endif()
endfunction()
