"""How both programs are asked: every option that the yardstick uses, as data."""

# Lightwell: what follows `--samples`, `--accuracy` or `--quality`, cheapest first.
LADDERS = {
    "samples": {"": ["--samples 32", "--samples 128", "--samples 512", "--samples 2048"],
                "d": ["--samples 128", "--samples 256", "--samples 512"]},
    "accuracy": {"": ["--accuracy 10%", "--accuracy 5%", "--accuracy 2%", "--accuracy 1%", "--accuracy 0.5%"]},
    "quality": {"": ["--quality draft", "--quality normal", "--quality fine"]},
    "time": {"": ["--time 0.1s", "--time 0.3s", "--time 1s", "--time 3s", "--time 10s"]},
}
# Techniques that can be switched off, one at a time; `--also "--without NAME"` measures a row without one.
TECHNIQUES = ("ambient", "cache", "gradients", "hessian", "image", "adaptive", "subdivision", "virtual", "secondary", "tree", "analytic")


def lightwell_ladder(kind, row):
    return LADDERS[kind].get(row[0], LADDERS[kind][""])


# Radiance: what its driver `rad` sets for QUALITY = Low, Medium (DETAIL and VARIABILITY Medium, PENUMBRAS on); {ar} is
# 16 or 32 times the size of the octree over the mean size of the room.
LOW = "-dp 128 -ar {ar} -ds .4 -dt .1 -dc .5 -dr 0 -ss 0 -st .5 -aa .25 -ad 512 -as 0 -lr 6 -lw .001"
MEDIUM = "-dp 512 -ar {ar2} -ds .2 -dj .9 -dt .07 -dc .7 -dr 1 -ss 1 -st .1 -aa .15 -ad 800 -as 128 -lr 8 -lw 1e-4"
# No cache, no thresholds, paths ended by chance.
BRUTE = "-u+ -aa 0 -as 0 -lr -24 -lw 1e-8 -ds .1 -dj 1 -dt 0 -dc 1 -dr 2 -st 0 -ss 1"
EXPERT = LOW.replace("-dr 0", "-dr 2").replace("-lr 6 -lw .001", "-lr 200 -lw 1e-7")


def radiance_settings(row, room_ratio):
    """@param room_ratio  size of the octree over the mean size of the room
    @return  (name, options) of each setting, the known good ones of the row"""
    sizes = {"ar": round(16 * room_ratio), "ar2": round(32 * room_ratio)}
    low, medium, expert = (text.format(**sizes) for text in (LOW, MEDIUM, EXPERT))
    bounces = {"a80": 20, "a95": 60, "a99": 200}
    if row in bounces:
        return [("Low, ab 40", f"{low} -ab 40"), (f"expert, ab {bounces[row]}", f"{expert} -ab {bounces[row]}")]
    if row.startswith("d"):
        return [("every lamp, no penumbra", "-ab 0 -dt 0 -dc 1 -ds 0 -st 1"), ("Low", f"{low} -ab 0"),
                ("Medium", f"{medium} -ab 0")]
    if row.startswith("c"):
        return [("Low, ab 6", f"{low} -ab 6"), ("Low but -dr 2, ab 6", f"{low.replace('-dr 0', '-dr 2')} -ab 6"),
                ("brute, ad 200", f"{BRUTE} -ab 12 -ad 200")]
    if row.startswith("hall"):
        return [(f"-dt {dt} -dc {dc}", f"-ab 0 -dt {dt} -dc {dc} -ds 0 -st 1") for dt, dc in
                ((0, 1), (0.01, 0.95), (0.05, 0.75), (0.1, 0.5))]
    return [("Low, ab 6", f"{low} -ab 6"), ("expert, ab 8", f"{expert} -ab 8"), ("Medium, ab 6", f"{medium} -ab 6"),
            ("brute, ad 100", f"{BRUTE} -ab 12 -ad 100")]
