# Flags of every target of the project. -ffp-contract=off is required: fused multiply-adds would change the bits of laws
# (docs/architecture.md: the same bits on every machine). Never use -ffast-math.
function(pliant_set_flags target)
    target_compile_options(${target} PRIVATE
        -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
        $<$<BOOL:${PLIANT_WARNINGS_AS_ERRORS}>:-Werror>)
    # Vectors wider than the baseline are never passed to functions that are not inlined.
    target_compile_options(${target} PRIVATE
        -Wno-psabi $<$<CXX_COMPILER_ID:GNU>:-Wno-ignored-attributes>)
    # GCC 12 falsely warns of overlaps in std::string operations (its bug 105329).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
    if(PLIANT_SANITIZE)
        target_compile_options(${target} PUBLIC -fsanitize=${PLIANT_SANITIZE} -fno-omit-frame-pointer)
        target_link_options(${target} PUBLIC -fsanitize=${PLIANT_SANITIZE})
    endif()
endfunction()
