# RUN: python3 %s | kbc drive session.d/works.kb 2> %t/errors | grep -o '"t":[^,]*,"speed":[^,]*\|"mission":[a-z]*\|"code":"[A-Z0-9]*"' | tr '\n' ' '; sed -n 1,4p %t/errors; grep -A 2 KB1500 %t/errors
# The sign of a neighbour is none, with a warning. A field that is misspelt is refused, line by line; the button beside it is heard.
def say(t, more=""):
    print('{"t":%g,"line":[0.05,0.05,0.95,0.05,0.05],"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_m_s":0,"odometry_turned_rad":0%s}' % (t, more))

for i in range(20):
    say(i / 20, ',"buttons":["Go"]' if 4 < i < 8 else '')
for i in range(20, 23):
    say(i / 20, ',"buttons":["Abort"],"tag":{"landmark":"Kiosk","exit":"W"},"compas":1')
say(1.15, ',"tag":{"landmark":"Kiosk","exit":"W"}')
for i in range(24, 28):
    say(i / 20)
