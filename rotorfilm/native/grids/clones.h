/* One function for every width of a machine's registers, chosen when the library is loaded.

   All widths give the same digits: the compiler must not contract products and sums, nor change their order.
   Libraries that have no use for such functions would keep them nevertheless, and so get plain ones. */
#ifndef ROTORFILM_CLONES_H
#define ROTORFILM_CLONES_H

#include <stddef.h>

#include "../kernels/kernel_list.h"

#if defined(RF_SUBSET)
#define RF_ON_GRIDS (((RF_SUBSET) & (RF_ROTORFILM_GRIDS | RF_ROTORFILM_OIL | RF_ROTORFILM_LOOPS)) != 0)
#else
#define RF_ON_GRIDS 1
#endif

#if RF_ON_GRIDS && defined(__GNUC__) && !defined(__clang__) && defined(__GLIBC__) && defined(__x86_64__)      \
    && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RF_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define RF_CLONES
#endif

/* The same of films that conserve their oil, which other grids do not have. */
#if !defined(RF_SUBSET) || RF_SUBSET == RF_ROTORFILM_OIL || RF_SUBSET == RF_ROTORFILM_LOOPS
#define RF_CLONES_OF_OIL RF_CLONES
#else
#define RF_CLONES_OF_OIL
#endif

#endif
