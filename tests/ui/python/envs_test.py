"""Environments: the interface of Gymnasium, the same results by seed, batches, and a controller that earns more."""

import importlib.util
import unittest

import numpy as np

import octant

camera = octant.Camera(24, 20)


def make(**keywords):
    return octant.envs.FollowPath(**{"camera": camera, "triangles": 500, **keywords})


def towards_the_path(info):
    """Turns and climbs towards the place where the path will be."""
    forward, right, down = info["ahead_m"]
    bearing = np.arctan2(right, max(forward, 1.0))
    return np.array([5.0 * bearing, 0.0, info["trim_throttle"] - 0.03 * down, 0.0])


def episode(env, seed, act, steps):
    observation, info = env.reset(seed=seed)
    pictures, rewards = [observation], []
    for _ in range(steps):
        observation, reward, terminated, truncated, info = env.step(act(info))
        pictures.append(observation)
        rewards.append(reward)
        if terminated or truncated:
            break
    return np.stack(pictures), np.array(rewards), terminated, truncated, info


class One(unittest.TestCase):
    def test_the_interface(self):
        env = make()
        observation, info = env.reset(seed=1)
        self.assertTrue(env.observation_space.contains(observation))
        self.assertEqual(env.observation_space.shape, (20, 24, 3))
        self.assertEqual(env.observation_space.dtype, np.uint8)
        self.assertEqual((env.action_space.shape, env.action_space.dtype), ((4,), np.float32))
        self.assertTrue(env.action_space.contains(env.action_space.sample(seed=5)))
        np.testing.assert_array_equal(env.action_space.sample(seed=5), env.action_space.sample(seed=5))
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample(seed=5))
        self.assertIsInstance(reward, float)
        self.assertIsInstance(terminated, bool)
        self.assertIsInstance(truncated, bool)
        self.assertIsInstance(info, dict)
        self.assertEqual(env.render().shape, (20, 24, 3))
        if importlib.util.find_spec("gymnasium"):
            import gymnasium

            self.assertTrue(callable(gymnasium.Env.step))

    def test_the_same_seed_and_actions_give_the_same(self):
        act = np.random.default_rng(3).uniform(-0.3, 0.3, (12, 4))
        runs = [episode(make(), 7, lambda info, left=iter(act): next(left), 12) for _ in range(2)]
        np.testing.assert_array_equal(runs[0][0], runs[1][0])
        np.testing.assert_array_equal(runs[0][1], runs[1][1])
        other = episode(make(), 8, lambda info, left=iter(act): next(left), 12)
        self.assertFalse(np.array_equal(runs[0][0], other[0]))

    def test_a_controller_earns_more_than_chance_and_reaches_the_end(self):
        env = make()
        random = np.random.default_rng(1)
        by_chance = episode(env, 1, lambda info: random.uniform(-1, 1, 4), 600)
        steered = episode(env, 1, towards_the_path, 600)
        self.assertGreater(steered[1].sum(), 3 * by_chance[1].sum())
        self.assertTrue(steered[3], steered[4])
        self.assertGreater(steered[1].mean(), 0.9)
        self.assertTrue((steered[1] >= 0).all() and (steered[1] <= 1).all())

    def test_the_ground_ends_an_episode(self):
        env = make()
        _, rewards, terminated, truncated, info = episode(env, 2, lambda info: [0, 0, -1, 0], 600)
        self.assertTrue(terminated)
        self.assertFalse(truncated)
        self.assertEqual(rewards[-1], 0)
        self.assertLessEqual(info["above_ground_m"], 0)
        with self.assertRaises(ValueError):
            env.step([0, 0, 0, 0])
        env.reset(seed=2)
        env.step([0, 0, 0, 0])

    def test_several_outputs_are_a_dictionary(self):
        env = make(outputs=["rgb", "depth_m", "class_id"], view="chase")
        observation, _ = env.reset(seed=1)
        self.assertEqual(set(observation), {"rgb", "depth_m", "class_id"})
        self.assertIn(octant.classes.index("aircraft"), observation["class_id"])
        for name, space in env.observation_space.items():
            self.assertEqual((space.shape, space.dtype), (observation[name].shape, observation[name].dtype))
        nose = make(outputs="class_id").reset(seed=1)[0]
        self.assertNotIn(octant.classes.index("aircraft"), nose)

    def test_the_f15_flies_too(self):
        env = make(path="straight", aircraft="f15", terrain="canyon")
        _, rewards, terminated, _, _ = episode(env, 1, towards_the_path, 30)
        self.assertFalse(terminated)
        self.assertGreater(rewards.mean(), 0.8)

    def test_wrong_arguments_are_refused(self):
        for wrong in (
            {"view": "odd"}, {"step_s": 0}, {"step_s": np.inf}, {"step_s": np.nan}, {"step_s": "a"}, {"outputs": ["odd"]},
            {"outputs": 5}, {"start_error_m": -1}, {"start_error_m": None}, {"path": "odd"},
        ):  # fmt: skip
            with self.assertRaises(ValueError, msg=str(wrong)):
                make(**wrong)
        for count in (0, 1.5, None):
            with self.assertRaises(ValueError, msg=str(count)):
                octant.envs.batch(make, count=count)
        env = make()
        with self.assertRaises(ValueError):
            env.step([0, 0, 0, 0])
        env.reset(seed=1)
        for seed in (1.5, "one", -1):
            with self.assertRaises(ValueError, msg=str(seed)):
                env.reset(seed=seed)
        for action in ([0, 0, 0], [0, 0, 0, np.nan], "left"):
            with self.assertRaises(ValueError):
                env.step(action)
        env.close()
        with self.assertRaises(ValueError):
            env.reset(seed=1)


class Many(unittest.TestCase):
    def test_a_batch_is_its_environments_one_by_one(self):
        many = octant.envs.batch(make, count=4)
        actions = np.random.default_rng(2).uniform(-0.5, 0.5, (6, 4, 4))
        first, info = many.reset(seed=10)
        batches = [many.step(each) for each in actions]
        for i in range(4):
            alone = make()
            np.testing.assert_array_equal(alone.reset(seed=10 + i)[0], first[i])
            for action, batch in zip(actions, batches):
                observation, reward, terminated, truncated, info = alone.step(action[i])
                np.testing.assert_array_equal(observation, batch[0][i])
                self.assertEqual((reward, terminated, truncated), (batch[1][i], batch[2][i], batch[3][i]))
                np.testing.assert_array_equal(info["position_m"], batch[4]["position_m"][i])

    def test_ended_environments_begin_anew(self):
        many = octant.envs.batch(make, count=2)
        many.reset(seed=[1, 2])
        down = np.array([[0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 0.2, 0.0]])
        for _ in range(300):
            _, rewards, terminated, _, info = many.step(down)
            if terminated[0]:
                break
        self.assertTrue(terminated[0])
        _, rewards, terminated, _, info = many.step(down)
        self.assertFalse(terminated[0])
        self.assertEqual(rewards[0], 0)
        self.assertEqual(info["time_s"][0], 0)

    def test_environments_share_their_world(self):
        many = octant.envs.batch(make, count=3)
        self.assertEqual(len({id(each._shared) for each in many.envs}), 1)
        self.assertEqual(many.observation_space.shape, (3, 20, 24, 3))
        self.assertEqual(many.action_space.sample(seed=1).shape, (3, 4))
        mixed = iter([{"terrain": "hills"}, {"terrain": "canyon"}, {"terrain": "hills"}])
        two_worlds = octant.envs.batch(lambda: make(**next(mixed)), count=3)
        observations, _ = two_worlds.reset(seed=1)
        np.testing.assert_array_equal(observations[1], make(terrain="canyon").reset(seed=2)[0])
        with self.assertRaises(ValueError):
            many.step(np.zeros((2, 4)))
        with self.assertRaises(ValueError):
            octant.envs.batch(make, count=0)
        cameras = iter([camera, octant.Camera(10, 10)])
        with self.assertRaises(ValueError):
            octant.envs.batch(lambda: make(camera=next(cameras)), count=2)


if __name__ == "__main__":
    unittest.main()
