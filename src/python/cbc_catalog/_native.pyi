from . import Catalog as Catalog
from . import Change as Change
from . import Coordinator as Coordinator
from . import Event as Event
from . import Option as Option
from . import StoppedTask as StoppedTask

def kind_of(name: bytes, text: bytes) -> tuple[str, bool]: ...
def list_properties(path: bytes, catalog: bytes) -> list[tuple[int, str]]: ...
