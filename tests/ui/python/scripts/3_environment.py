env = octant.envs.FollowPath(path="turn", aircraft="500md", camera=octant.Camera(84, 84, fov_deg=80), terrain="hills")
observation, info = env.reset(seed=1)
observation, reward, terminated, truncated, info = env.step([0.0, 0.1, 0.5, 0.0])    # roll, pitch, collective/throttle, yaw in -1..1
many = octant.envs.batch(lambda: octant.envs.FollowPath(...), count=64)              # one call steps and draws all 64
