import numpy as np, octant

world = octant.World(terrain="hills", aircraft=["f15-detailed", "500md-detailed"], sun_elevation_deg=25, triangles=3000)
camera = octant.Camera(width=128, height=128, fov_deg=60)          # pinhole; K and distortion below
n = 100
eye = world.ground.random_positions(n, above_ground_m=(30, 300), seed=7)   # (n, 3) east, north, up
look = octant.attitudes(heading_deg=np.linspace(0, 360, n), pitch_deg=-10)  # (n, 4) quaternions w, x, y, z
frames = world.render(camera, eye, look, previous_eye=eye - 1.0, outputs=["rgb", "depth_m", "class_id", "object_id", "normal", "flow_px"])
frames.rgb.shape       # (100, 128, 128, 3) uint8
frames.depth_m         # (100, 128, 128) float32: distance along the optical axis; inf where the sky is
frames.class_id        # uint8, names in octant.classes: sky, terrain, water, road, building, tree, aircraft, cloud ...
frames.object_id       # uint32: 0 = none, 1.. = world.objects
