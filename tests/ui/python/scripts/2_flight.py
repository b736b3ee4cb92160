for frame in octant.fly("jinking", aircraft="f15", terrain="canyon", view="chase", size=(640, 360)):
    frame.rgb; frame.time_s; frame.states[0].position_m; frame.timing.draw_ms
table = octant.recording("my-flight").frames        # a mapping of numpy columns; pandas.DataFrame(table) works
octant.report(["my-flight", "other"], out="report.html")
