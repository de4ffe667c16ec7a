"""Results of experiments as charts: plain data for Plotly, in the page, in files and in standalone HTML."""
