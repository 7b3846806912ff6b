/* What the functions of the library answer. */
#ifndef ROTORFILM_STATUS_H
#define ROTORFILM_STATUS_H

/* In the order of their severity; of a batch, the most severe one. */
typedef enum rf_status {
    RF_OK = 0,
    RF_OUTSIDE = 1,    /* an answer, but beyond the verified range of the model */
    RF_UNDEFINED = 2,  /* no derivative exists here */
    RF_AT_WALL = 3,    /* the journal touches the wall */
    RF_NOT_FINITE = 4, /* an argument or the answer is not finite */
    RF_INVALID = 5,    /* a parameter or a table breaks its rule */
    RF_STUCK = 6,      /* an iteration or the time integration cannot go on */
    RF_MEMORY = 7
} rf_status;

/* Why, with values; written for every answer but RF_OK. */
typedef struct rf_message {
    char text[320];
} rf_message;

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
/* Write the message and return the status. */
int rf_say(rf_message *message, int status, const char *format, ...);

#endif
