/* One function for every width of a machine's registers, chosen when the library is loaded.

   All widths give the same digits: the compiler must not contract products and sums, nor change their order. */
#ifndef ROTORFILM_CLONES_H
#define ROTORFILM_CLONES_H

#if defined(__GNUC__) && !defined(__clang__) && defined(__linux__) && defined(__x86_64__)                     \
    && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RF_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define RF_CLONES
#endif

#endif
