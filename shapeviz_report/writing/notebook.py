"""A report as a notebook shows it: the site itself, in a frame."""

from __future__ import annotations

import base64
import gzip
from html import escape

from shapeviz_report.types import Report
from shapeviz_report.writing.writer import whole_site

MOST_SHOWN = 20_000_000
"""Letters of the largest frame that is put into a notebook, which keeps it in its own file."""

HEIGHT = 820
"""Of the frame, in pixels."""

# A site in one file shows another page by loading itself again, which a document in a frame cannot: it has no address.
# So the frame holds the site packed, and makes a frame in itself for every page that `opening/single-file.js` asks for.
# The base is for links, which would lead to the notebook's own page without it.
_WRAPPER = """\
<!doctype html>
<meta charset="utf-8">
<title>{title}</title>
<style>body {{ margin: 0 }} iframe {{ border: 0; width: 100vw; height: 100vh; display: block }}</style>
<script type="module">
const packed = Uint8Array.from(atob("{packed}"), (letter) => letter.charCodeAt(0));
const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
const [before, after] = (await new Response(stream).text()).split(/<head>(.*)/s);
const show = (hash) => {{
  const open = `<head><base href="about:srcdoc"><script>location.hash = ${{JSON.stringify(hash)}}<\\/script>`;
  const frame = document.createElement("iframe");
  frame.name = "shapeviz-framed";
  frame.title = document.title;
  frame.srcdoc = before + open + after;
  document.body.replaceChildren(frame);
}};
addEventListener("message", ({{ data, source }}) => {{
  if (source === frames[0] && /^#[^<]*$/.test(data)) show(data);
}});
show("");
</script>
"""


class ShownReport(Report):
    """A report that notebooks show as its site."""

    def _repr_html_(self) -> str:
        """The site in one file, as with ``--single-file``, in a frame that reaches nothing around it."""
        title = escape(self.database.name)
        packed = base64.b64encode(gzip.compress(whole_site(self), mtime=0)).decode()
        if len(packed) > MOST_SHOWN:
            return (
                f"<p>{escape(repr(self))} Its site would add {len(packed) / 1e6:,.0f} MB to this notebook: open the "
                "<code>index.html</code> of the folder that it was built in.</p>"
            )
        document = escape(_WRAPPER.format(title=title, packed=packed))
        return (
            f'<iframe title="{title}" sandbox="allow-scripts allow-downloads" '
            f'style="width: 100%; height: {HEIGHT}px; border: 0" srcdoc="{document}"></iframe>'
        )
