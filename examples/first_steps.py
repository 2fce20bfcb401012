# %% [markdown]
# # First steps
#
# A recorded flight that the model does not explain: how far off is it, which physical effect is missing,
# and does the error fall once that effect is added? Run the cells one by one, or all of it with
# `python examples/first_steps.py`.
#
# The flight was made by a numerical simulator that shares no equation with the model. Something was hidden in it.

# %%
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy import signal

import ragg

here = Path("examples") if Path("examples").is_dir() else Path()
work = Path("first-steps")
shutil.rmtree(work, ignore_errors=True)
work.mkdir()

# %% [markdown]
# ## Load
#
# A *model directory* holds the instrument's test sheet (`model.toml`: every number with its unit) and the effects
# that its model has beyond the paper's. This one begins with the packaged example and no effects.
# A flight is a table with one row a sample: motion, temperature, and the output `G_out`.

# %%
model = ragg.new(work / "model")
flights = ragg.read_flights(model, [here / "demo-flight.parquet"])
flight = flights[0]
print(
    f"{flight.name}: {flight.duration:.0f} s at {flight.rate:.0f} Hz; channels: {', '.join(flight.channels)}"
)

# %%
fig, (top, bottom) = plt.subplots(2, sharex=True, figsize=(9, 4), layout="constrained")
for name in ("a_x", "a_y", "a_z"):
    top.plot(flight.time, flight.channels[name] / model.instrument.g0, lw=0.5, label=name)
top.set_ylabel("specific force, g")
top.legend(loc="upper right", ncols=3)
bottom.plot(flight.time, flight.outputs["G_out"], lw=0.5)
bottom.set(xlabel="time, s", ylabel="G_out, V")
fig.savefig(work / "flight.png")

# %% [markdown]
# ## Compare
#
# The error is the output that the model does not predict, in eötvös (1 Eo = 1e-9 s⁻²). *Nominal*: with the values of
# the test sheet. *Calibrated*: the model's own parameters fitted to the flight. *Held out*: fitted on half of the
# time, scored on the other half. The *noise floor* is what even a perfect model would leave.

# %%
before = ragg.compare(model, flights)
print(
    f"calibrated {before.calibrated.rms_Eo:.2f} Eo, noise {before.noise_floor:.2f} Eo: adequate? {before.adequate}"
)
before

# %% [markdown]
# Twice the noise, and it fails in step with `temperature`. That is a hint; the diagnosis is a test.
#
# ## Diagnose
#
# Every effect of the catalogue is tested on what no parameter of the model can absorb. The verdict is `adequate`,
# `missing-effect` or `unexplained`: the program does not name an effect that does not bring the error down to noise.

# %%
diagnosis = ragg.diagnose(model, flights)
print(f"{diagnosis.verdict}: {', '.join(diagnosis.found)}")
diagnosis

# %% [markdown]
# ## Add
#
# The effect is derived into the model (new equations, not a correction on top), calibrated, and kept in the
# model directory with its history. `ragg.remove` undoes it.

# %%
step = ragg.add(model, diagnosis.found[0], flights)
assert step.after is not None
after = step.after
print(f"{before.calibrated.rms_Eo:.2f} Eo before, {after.calibrated.rms_Eo:.2f} Eo after")
step

# %% [markdown]
# ## Watch the error fall
#
# The residual over time, and its spectrum: what was above the noise is gone.

# %%
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
for c, label in ((before, "before"), (after, "after")):
    residual = c.residual[0] / c.fitted.k_ggi
    left.plot(flight.time, residual, lw=0.4, label=f"{label}: {c.calibrated.rms_Eo:.2f} Eo rms")
    frequency, density = signal.welch(residual, flight.rate, nperseg=2048)
    right.loglog(frequency[1:], np.sqrt(density[1:]), lw=0.8, label=label)
left.set(xlabel="time, s", ylabel="residual, Eo")
right.set(xlabel="frequency, Hz", ylabel="residual, Eo/√Hz")
for axes in (left, right):
    axes.legend(loc="upper right")
fig.savefig(work / "residual.png")

# %% [markdown]
# Is there anything left? Diagnose again, with the model that now has the effect.

# %%
again = ragg.diagnose(step.loaded, flights)
print(f"{again.verdict}; steps so far: {', '.join(s.action for s in step.loaded.directory.history)}")
step.loaded

# %% [markdown]
# ## Next
#
# - Your own instrument: `ragg.new("my-model", "my-test-sheet.toml")`, then the same steps with your flights.
# - Reports to keep and to send: `ragg diagnose my-model flight.csv --report diagnosis.html`.
# - Hundreds of flights: `ragg.survey(model, files)`, see `docs/survey.md`.
# - All effects that are known: `ragg effects`.
