# RUN: python3 %s | kbc drive session.d/works.kb 2> %t/errors | cut -c 1-250; cat %t/errors
# One wrong `t`, and the robot drives on; a clock that was set back, and it stands until a button is pressed.
def say(t, more=""):
    print('{"t":%g,"line":[0.05,0.05,0.95,0.05,0.05],"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_m_s":0,"odometry_turned_rad":0%s}' % (t, more))

for t in (10.0, 10.02, 4e9, 10.06, 10.08, 3.0, 3.02, 3.04):
    say(t)
say(3.06, ',"buttons":["Resume"]')
say(3.08)
