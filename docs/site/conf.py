"""The pages of docs/ as a site that needs no network: Sphinx with MyST reads them as they stand, and everything comes from
Debian packages of 12 and 13. (MkDocs Material of Debian 12 cannot search without a server; its Furo asks for files that a folder does not have.)

    sphinx-build -c docs/site docs build/docs      (./quickstart docs installs what it needs first)

`navigation` is the order of the pages, in the four kinds of Diataxis and reports. A page that it does not name stands under "More"."""
import pathlib
import re
import shutil

docs = pathlib.Path(__file__).resolve().parents[1]
studies = sorted(f"reports/{page.stem}" for page in docs.glob("reports/study-*.md"))  # as far as they have been run
navigation = {
    "Start": ["start/install", "start/first-run", "start/reading-a-result"],
    "Tutorials": ["tutorials/laminate", "tutorials/explicit-or-adaptive", "tutorials/how-sure", "tutorials/slow-test", "tutorials/blast-on-a-window"],
    "How to": ["howto/contact", "howto/loads", "howto/shapes", "howto/tolerance", "howto/resume", "howto/studies", "howto/clusters", "howto/python", "howto/report", "howto/paraview",
               "howto/own-law", "howto/own-observer", "howto/development"],
    "Theory": ["theory/index", "theory/paper", "theory/strain-and-stress", "theory/damage", "theory/bifurcation", "theory/decohesion", "theory/von-mises", "theory/drucker-prager",
               "theory/events", "theory/other-laws", "theory/local-equations", "theory/discrete-equations", "theory/grid", "theory/boundaries", "theory/loads", "theory/contact",
               "theory/turning-bodies", "theory/explicit", "theory/adaptive", "theory/integrators", "theory/energy", "theory/failure", "theory/resolution"],
    "Reference": ["reference/scene", "reference/materials", "reference/result"],
    "Reports": ["reports/verification", "reports/verification-measured", "reports/findings", *studies, "reports/performance", "reports/performance-measurements", "reports/performance-history"],
}
named = {page for pages in navigation.values() for page in pages}
more = sorted({page.relative_to(docs).with_suffix("").as_posix() for page in docs.rglob("*.md")} - named - {"index"})
if more:
    navigation["More"] = more

project = "vitrum"
author = copyright = "The vitrum developers"
root_doc = "index"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
exclude_patterns = ["site"]

html_theme = "sphinx_rtd_theme"
html_title = "vitrum"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
# SVG output: its glyphs are scripts, which browsers also load from a folder without a server.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"tex2jax": {"processClass": "math"}, "SVG": {"linebreaks": {"automatic": True, "width": "container"}}, "showMathMenu": False}
myst_update_mathjax = False  # that is for MathJax 3
mathjax = pathlib.Path("/usr/share/javascript/mathjax")


def add_navigation(app, page, source):
    if page == root_doc:
        for caption, pages in navigation.items():
            source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(pages) + "\n```\n"


def name_what_lies_outside(app, page, source):
    """A link to Markdown outside docs/ becomes the file's name: the site has no such page. (Of other files it keeps copies.)"""
    folder = (pathlib.Path(app.srcdir) / page).parent

    def named(link):
        target = (folder / link["path"]).resolve()
        return link[0] if target.is_relative_to(app.srcdir) else f"{link['text']} (`{target.relative_to(pathlib.Path(app.srcdir).parent)}`)"
    source[0] = re.sub(r"\[(?P<text>[^]]*)\]\((?P<path>\.\.[^)#]*\.md)(#[^)]*)?\)", named, source[0])


def copy_mathjax(app, failed):
    """What TeX to SVG asks for: a twentieth of the package."""
    for part in () if failed else ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG/*.js", "jax/output/SVG/autoload",
                                   "jax/output/SVG/fonts/TeX"):
        for origin in mathjax.glob(part):
            target = pathlib.Path(app.outdir) / "_static/mathjax" / origin.relative_to(mathjax)
            target.parent.mkdir(parents=True, exist_ok=True)
            if origin.is_dir():
                shutil.copytree(origin, target, dirs_exist_ok=True)
            else:
                shutil.copy(origin, target)


def setup(app):
    app.connect("env-get-outdated", lambda *_: [root_doc])  # where the navigation stands: a new page changes it, and no text of its own
    app.connect("source-read", add_navigation)
    app.connect("source-read", name_what_lies_outside)
    app.connect("build-finished", copy_mathjax)
