# SPDX-License-Identifier: MIT
# A notebook as a script: editors run the cells at "# %%" one by one.
# %% A scene on Bullet, as arrays
import matplotlib.pyplot as plt
import numpy as np

import boxstream

poses, pairs = boxstream.simulate("pile", steps=150)
print(f"{poses.shape[1]} objects, {len(pairs)} steps")

# %% Heights while they fall, and pairs of boxes
heights = poses[:, :, 1]
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
left.fill_between(range(len(heights)), *np.nanpercentile(heights, [10, 90], axis=1), alpha=0.3)
left.plot(np.nanmedian(heights, axis=1))
left.set(xlabel="step", ylabel="height, m", title="median, and all but a fifth")
right.plot(range(1, len(pairs) + 1), [len(each) for each in pairs])
right.set(xlabel="step", ylabel="pairs", title="pairs that the broad-phase holds")

# %% Which objects stay near each other: pairs of the last step that were there twenty steps before
old, new = (set(map(tuple, each.tolist())) for each in (pairs[-21], pairs[-1]))
print(f"{len(old & new)} of {len(new)} pairs are older than 20 steps")
figure.savefig("pile.png")
