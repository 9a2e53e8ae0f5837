/* A loop as firmware has it. What the sensors say is read from a table here, a row for each change. */
#include <stdio.h>

#include "mind.h"

struct reading { int at_ms; float button, wall; };

static const struct reading readings[] = {{0, -1, -1}, {500, 1, -1}, {600, -1, -1}, {1500, -1, 0.9f}, {2200, -1, -1}, {4000, -1, 0.9f}};

int main(void)
{
    enum { period_ms = 100 };
    size_t next = 0;
    enum mind_strategy before = MIND_NOTHING;
    bool was_stuck = false;
    for (int now_ms = 0; now_ms <= 8000; now_ms += period_ms) {
        if (next < sizeof readings / sizeof readings[0] && readings[next].at_ms <= now_ms) {
            mind_set(MIND_BUTTON, readings[next].button);
            mind_set(MIND_WALL, readings[next].wall);
            ++next;
        }
        const enum mind_strategy drives = mind_tick(period_ms);
        if (drives != before) printf("%4d ms  %s at %.1f m/s\n", now_ms, mind_name(drives), mind_speed());
        if (mind_stuck() != was_stuck) printf("%4d ms  the lamp is %s\n", now_ms, mind_stuck() ? "on" : "off");
        before = drives;
        was_stuck = mind_stuck();
    }
    return 0;
}
