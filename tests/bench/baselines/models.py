"""What is compared, by name; each follows `fit`, `updated` and `predict` of `lfd.models.model.MovementModel`."""

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
from tests.bench.baselines.anchored import AnchoredMean, AnchoredNearest
from tests.bench.baselines.anchored_promp import AnchoredProMP
from tests.bench.baselines.gaussian_process import GaussianProcess
from tests.bench.baselines.kmp import KMP
from tests.bench.baselines.tpgmm import TPGMM

DEFAULT = "default"
THESIS = "thesis"
MODELS = {
    DEFAULT: AdaptiveProMP,
    THESIS: ConditionedProMP,
    "thesis + anchor": AnchoredProMP,
    "mean + anchor": AnchoredMean,
    "nearest + anchor": AnchoredNearest,
    "gaussian process": GaussianProcess,
    "kmp": KMP,
    "tp-gmm": TPGMM,
}
BASELINES = tuple(name for name in MODELS if name != DEFAULT)
