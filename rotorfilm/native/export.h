/* What leaves the library: everything else is hidden. */
#ifndef ROTORFILM_EXPORT_H
#define ROTORFILM_EXPORT_H

#if defined(_WIN32)
#define RF_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define RF_EXPORT __attribute__((visibility("default")))
#else
#define RF_EXPORT
#endif

#endif
