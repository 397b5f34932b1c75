"""What `breccia live` runs in ParaView (paraview --script=open_live_view.py)."""

import live_view

live_view.start()
