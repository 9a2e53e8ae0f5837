# RUN: python3 %s | kbc drive session.d/works.kb 2> %t/errors | cut -c 1-100; cat %t/errors
# The line of 3 s was sent before the pause. A line that comes twice is answered twice; an empty one is none.
def say(t, more=""):
    print('{"t":%g,"line":[0.05,0.05,0.95,0.05,0.05],"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_m_s":0,"odometry_turned_rad":0%s}' % (t, more))

for t in (2.96, 2.98, 2.98):
    say(t)
print()
for t in (63, 3, 63.02):
    say(t)
