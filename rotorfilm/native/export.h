/* What Python calls leaves the library of films: everything else is hidden, in other libraries this too. */
#ifndef ROTORFILM_EXPORT_H
#define ROTORFILM_EXPORT_H

#include "kernels/kernel_list.h"

#if defined(RF_SUBSET) && RF_SUBSET != RF_ROTORFILM
#define RF_EXPORT
#elif defined(_WIN32)
#define RF_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define RF_EXPORT __attribute__((visibility("default")))
#else
#define RF_EXPORT
#endif

/* The same of the library of loops. */
#if defined(RF_SUBSET) && RF_SUBSET != RF_ROTORFILM_LOOPS
#define RF_EXPORT_LOOP
#elif defined(_WIN32)
#define RF_EXPORT_LOOP __declspec(dllexport)
#elif defined(__GNUC__)
#define RF_EXPORT_LOOP __attribute__((visibility("default")))
#else
#define RF_EXPORT_LOOP
#endif

/* The same of the library of the co-simulation master. */
#if defined(RF_SUBSET) && RF_SUBSET != RF_ROTORFILM_MASTER
#define RF_EXPORT_MASTER
#elif defined(_WIN32)
#define RF_EXPORT_MASTER __declspec(dllexport)
#elif defined(__GNUC__)
#define RF_EXPORT_MASTER __attribute__((visibility("default")))
#else
#define RF_EXPORT_MASTER
#endif

#endif
