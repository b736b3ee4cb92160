world.set_states(octant.states(position_m=p, attitude=q, kind=["f15"]))   # from JSBSim, a filter, a log, a learned model
image = world.render(camera, p[0] - offset, q[0]).rgb[0]
