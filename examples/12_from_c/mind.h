/* The mind of bumper.kb for programs in C. There is one mind; it needs no heap. Calls come from one thread. */
#ifndef MIND_H
#define MIND_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* mind.cc checks these numbers against the knowledge base while it is compiled. */
enum mind_fact { MIND_BUTTON, MIND_WALL };
enum mind_strategy { MIND_DRIVE_AHEAD, MIND_DRIVE_BACK, MIND_NOTHING };

/* A certainty from -1 to 1; it stays until it is set again. */
void mind_set(enum mind_fact fact, float certainty);
/* One tick, `ms` after the last one. What is to drive now. */
enum mind_strategy mind_tick(uint32_t ms);
/* The speed that the control line of the strategy which drives asks for, in m/s; 0 if nothing drives. */
float mind_speed(void);
/* Whether the robot is wedged in. */
bool mind_stuck(void);
/* The name of a strategy in the knowledge base. */
const char *mind_name(enum mind_strategy strategy);

#ifdef __cplusplus
}
#endif
#endif
