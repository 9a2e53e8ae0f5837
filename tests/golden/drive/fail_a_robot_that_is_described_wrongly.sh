# RUN: printf "[robot]\nradius = 3\nwings = 2\n[[crossing]]\nlandmark = \"Hubb\"\nmethods = [\"mark\"]\n" > %t/robot.toml; kbc drive session.d/works.kb -w --robot %t/robot.toml < /dev/null
